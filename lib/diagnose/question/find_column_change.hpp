// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lib/diagnose/question/torque_balance.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

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
