// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/log/log_source.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Returns a sentence for each channel that is implausible in its unit at the beginning of a log, with the
/// log, the channel and what to write where; from ranges and the sample period alone, as `inspect` and
/// `diagnose` do. Rewinds the logs.
std::vector<std::string> implausible_units(std::span<LogSource* const> logs, const Robot& robot);

/// Throws Error(input) with the first of these sentences, if there are any.
void refuse_implausible_units(std::span<LogSource* const> logs, const Robot& robot);

}  // namespace faultline
