// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/explain_log.hpp"
#include "lib/identify/identification.hpp"
#include "lib/learn/twin/twin.hpp"
#include "lib/robot/normal_range.hpp"

namespace faultline {

/// How far healthy days of a robot differ, and the torque that its model misses, as the twin draws them.
DayDifferences day_differences(const RobotRows& robot);

/// The robot with at least the ranges that its file states, and the work piece that it states; ranges that
/// stand at their defaults say nothing.
RobotRows with_stated_ranges(RobotRows robot, const NormalRange& stated,
                             const std::vector<double>& torque_scale);

/// The identified robot with the friction that explains its logs, at coarse rates also with their noise and
/// the base parameters that explain them, where some bodies can have these: the twin must not differ from
/// what it is judged by.
Identification with_explained_robot(const Identification& identification, const RobotRows& robot);

}  // namespace faultline
