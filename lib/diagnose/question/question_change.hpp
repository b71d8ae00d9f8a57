// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "lib/diagnose/question/torque_balance.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// From a row on, the columns of a log mean something else than before.
struct ReadingChange {
  std::int64_t row = 0;  ///< about, from 1
  double at_s = 0.0;
  std::string what;  ///< a sentence's words such as "q2 is in deg"
};

/// Asks whether what looks like a fault from `onset_s` on is a change of the columns: other units, signs or
/// swapped columns that explain the torque of every joint behind it as well as the plain columns explain it
/// before, where the plain ones do not behind it. A fault of the robot is explained by none of them. Rewinds
/// the log before and after.
std::optional<ReadingChange> question_change(LogSource& log, const KnownRobot& robot, double onset_s);

}  // namespace faultline
