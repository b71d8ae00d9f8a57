// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Identification without masses and lengths, from logs that carry the same payload.
struct AlikeFit {
  Identification id;
  std::vector<bool> usable;  ///< by base parameter: the logs determine it
};

AlikeFit fit_alike(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                   const Progress& progress);

}  // namespace faultline
