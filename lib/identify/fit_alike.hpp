// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// All but masses and lengths, of logs that carry the same payload.
struct AlikeFit {
  Identification id;
  std::vector<bool> usable;  ///< by base parameter
};

AlikeFit fit_alike(std::span<LogSource* const> logs, const Robot& robot, const IdentifyOptions& options,
                   const Progress& progress);

}  // namespace faultline
