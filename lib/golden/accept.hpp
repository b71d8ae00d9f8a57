// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/golden/golden_folder.hpp"

namespace faultline {

/// A model that is to become the folder's.
struct NewModel {
  std::string model;
  std::string cases;
  const ModelAndCases* subject = nullptr;
};

/// Makes what `run` says of the named logs (and of "identification" and "model") what is expected of them,
/// and takes the new model when there is one. A named log whose files were changed is taken as it is now. All
/// appears with the new golden.toml, or nothing does. Throws Error(input), with nothing changed, for a log
/// that cannot be processed.
/// `defaults` hold for channels that the folder gives no tolerance.
void accept_golden(const std::string& folder, GoldenSet set, const GoldenRun& run,
                   const std::vector<std::string>& names, const NewModel& new_model = {},
                   const Tolerances& defaults = {});

}  // namespace faultline
