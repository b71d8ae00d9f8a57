// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lib/log/log_source.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Logs that carry the same mass at the tip.
struct PayloadGroup {
  KnownValue payload;
  std::vector<LogSource*> logs;
  std::vector<std::size_t> index;  ///< of each log among all
};

/// By robot.payloads, the logs without payload first. Throws Error(input) when every log carries one.
std::vector<PayloadGroup> group_by_payload(std::span<LogSource* const> logs, const Robot& robot);

}  // namespace faultline
