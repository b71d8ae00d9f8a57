// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "lib/log/log_source.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// A way the columns of the logs may mean something else than the robot file says, under which this robot
/// would explain their torque.
struct Misreading {
  std::string what;        ///< in a sentence's words, such as "q2 is in degrees"
  std::string cure;        ///< what to write where, an order
  double r2_before = 0.0;  ///< of the joint explained worst, as the logs are read now
  double r2_after = 0.0;   ///< the same if it was so
};

/// Tries other units, signs, swapped joints, swapped torques and directions of gravity on the beginning of
/// the logs; `what` is empty when none of them explains the torque clearly better.
Misreading find_misreading(std::span<LogSource* const> logs, const Robot& robot);

}  // namespace faultline
