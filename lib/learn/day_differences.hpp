// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/explain_log.hpp"
#include "lib/identify/identification.hpp"
#include "lib/learn/twin.hpp"
#include "lib/robot/normal_range.hpp"

namespace faultline {

/// Returns how far healthy days of a robot differ and the torque that its model misses, for runs of the twin.
DayDifferences day_differences(const RobotRows& robot);

/// Returns the robot with day variances of at least the ranges in its file, and with the work piece of the
/// file; ranges at their defaults change nothing.
RobotRows with_stated_ranges(RobotRows robot, const NormalRange& stated,
                             const std::vector<double>& torque_scale);

/// Returns the identified robot with friction and, if they are feasible, base parameters of the model that
/// explains its logs; at coarse rates also with its measurement noise. The twin then does not differ from the
/// model that judges it. Throws Error(input) if one-step predictions diverge.
Identification with_explained_robot(const Identification& identification, const RobotRows& robot);

}  // namespace faultline
