// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "apps/work/model_paths.hpp"
#include "lib/cases/case_base.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// A model with its case base, read once for any number of logs and never changed.
struct LoadedModel {
  ModelPaths paths;  ///< files that it was read from; empty for one that was learned and not written
  Model model;
  CaseBase cases;
};
using SharedModel = std::shared_ptr<const LoadedModel>;

}  // namespace faultline
