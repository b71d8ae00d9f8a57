// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

/// What healthy logs show without any model, one number a joint.
struct HealthyStatistics {
  std::vector<double> q_low, q_high;  ///< rad or m
  std::vector<double> velocity_rms;   ///< rad/s or m/s
  std::vector<double> torque_rms;     ///< N m or N
  std::vector<double> torque_largest;
  std::vector<double> torque_jump;   ///< largest from one sample to the next
  std::vector<double> repeat_share;  ///< samples that repeat the one before bit for bit
  std::vector<int> longest_repeat;   ///< samples
  long long rows = 0;
};

HealthyStatistics healthy_statistics(std::span<LogSource* const> logs, int joints);

}  // namespace faultline
