// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/question/torque_balance.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Why a log does not mean what the model takes it for.
struct ReadingDoubt {
  std::string
      what;  ///< likely cause, a sentence's words such as "the angles are in degrees"; empty: no doubt
  std::string cure;  ///< what to do about it, an order

  bool is_empty() const { return what.empty(); }
};

/// Asks whether a log ever fitted the robot of a model: whether each joint that moves has moments in which
/// the torque logged is the one needed, and a velocity that is the position's. Where it has none, other
/// units, signs, swapped columns, a late torque and a current are tried on the log's
/// beginning; without one that explains it, two joints that never come near their torque are another robot. A
/// fault that begins later, or on one joint, is no doubt. The log is at the rate of the model's logs. Rewinds
/// it before and after.
ReadingDoubt question_reading(LogSource& log, const KnownRobot& robot);

/// Asks whether a log at another rate than the model's logs, which have a row every `sample_period_s`, has
/// stamps that run too fast or too slow: whether its motion is explained when its rows are so far apart.
/// Rewinds the log before and after.
ReadingDoubt question_clock(LogSource& log, const KnownRobot& robot, double sample_period_s);

}  // namespace faultline
