// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
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

/// A change of the meaning of a log's columns from a row on.
struct ColumnChange {
  std::int64_t row = 0;  ///< about, from 1
  double at_s = 0.0;
  std::string what;  ///< the new meaning as a clause, such as "q2 is in degrees"
};

/// Tests whether an apparent fault from `onset_s` on is a change of the columns: other units, signs or
/// swapped columns that explain the torque of every joint after it about as well as the plain columns explain
/// it before, and one joint far better than the plain columns do. None of them explains a fault of the robot.
/// Returns the interpretation that fits best, nullopt if none does. Rewinds the log before and after.
std::optional<ColumnChange> find_column_change(LogSource& log, const KnownRobot& robot, double onset_s);

}  // namespace faultline
