// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "lib/log/log_source.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// An interpretation of the columns that differs from the robot file, under which this robot would explain
/// their torque.
struct Reinterpretation {
  std::string what;        ///< as part of a sentence, such as "q2 is in degrees"
  std::string cure;        ///< what to write where, as an instruction
  double r2_before = 0.0;  ///< of the worst explained joint, with the present interpretation
  double r2_after = 0.0;   ///< the same with the new interpretation
};

/// Tries other units, signs, swapped joints, swapped torques and directions of gravity on the beginning of
/// the logs; `what` is empty if none of them explains the torque clearly better.
Reinterpretation find_reinterpretation(std::span<LogSource* const> logs, const Robot& robot);

}  // namespace faultline
