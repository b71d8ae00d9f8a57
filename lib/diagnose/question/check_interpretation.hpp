// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/question/torque_balance.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// The likely reason for which a log contradicts the model from the start.
struct LogMismatch {
  std::string
      what;  ///< likely cause as a clause, such as "the angles are in degrees"; empty: no contradiction
  std::string cure;                  ///< what to do, as an instruction
  bool is_entry_of_columns = false;  ///< the cure is an entry of [log.columns] alone

  bool is_empty() const { return what.empty(); }
};

/// Tests whether a log ever fits the robot of a model: whether each joint that moves has moments in which the
/// logged torque is the required one, and a velocity that is the derivative of its position. If not, other
/// units, signs, swapped columns, a delayed torque and a current are tried on the beginning of the log; if
/// none explains it, two joints that never come near their required torque indicate another robot. A fault
/// that begins later, or on one joint, does not contradict the model. The log must be at the rate of the
/// model's logs. Rewinds it before and after.
LogMismatch check_interpretation(LogSource& log, const KnownRobot& robot);

/// Tests whether a log at another rate than the model's logs, which have a row every `sample_period_s`, has
/// stamps that run too fast or too slow: whether its motion is explained if its rows are `sample_period_s`
/// apart. Rewinds the log before and after.
LogMismatch check_clock(LogSource& log, const KnownRobot& robot, double sample_period_s);

}  // namespace faultline
