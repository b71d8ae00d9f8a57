// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/log/log.hpp"
#include "lib/reproduce/protocol/protocol.hpp"

namespace faultline {

struct BenchMotion {
  double duration_s = 60.0;
  double log_period_s = 0.073;
  int control_steps = 1;  ///< control steps a log row; the torque is held over each
  double noise = 0.0;     ///< of q and dq, standard deviation as a share of half the range
  int free_joint = 0;     ///< swings freely from `fault_s` on; 0 = no fault
  double fault_s = 0.0;
  std::uint64_t seed = 1;
};

/// Random point-to-point quintic moves of 1.2 to 1.8 s with dwells under computed torque, logged with the
/// torque asked for.
Log bench_log(const Robot& robot, const BenchMotion& motion);

}  // namespace faultline
