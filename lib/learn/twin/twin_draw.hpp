// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/random.hpp"
#include "lib/learn/twin/twin.hpp"

namespace faultline {

/// Length of a move over which the twin is about as fast as the logs.
double usual_move_s(const Twin& twin);

// One draw each of what a run is made of.
MotionSpec draw_motion(const Twin& twin, Random& random);
/// PD holds fewer robots than computed torque: a second attempt does without it.
ControllerSpec draw_controller(const Twin& twin, bool allow_pd, Random& random);
/// What the drives give beside what is logged, as far as it is normal: offset, torque constant, roughness.
DriveSpec draw_drives(const Twin& twin, Random& random);
/// Measurement noise of a day, within the normal range.
NoiseSpec draw_noise(const Twin& twin, Random& random);
/// What friction the robot has on a day, within the normal range.
void draw_day(const Twin& twin, Robot& robot, Random& random);
/// Somewhere outside the range seen in the logs, or none.
JointStops draw_stops(const Twin& twin, Random& random);
/// The fault asked for, and of one that passes perhaps a second push.
std::vector<SimulatedFault> draw_faults(const Twin& twin, const FaultLabel& label, double onset_s,
                                        Random& random);

}  // namespace faultline
