// SPDX-License-Identifier: MIT
#pragma once

#include "lib/simulate/motion.hpp"

namespace faultline {

/// The ranges that points are drawn from. Throws Error(usage) when `spec` does not fit the robot's joints.
JointRanges checked_ranges(const Robot& robot, const MotionSpec& spec);
/// Throws Error(usage) when the samples are no motion of this robot.
void check_replay(const Robot& robot, const SampledMotion& replay);

}  // namespace faultline
