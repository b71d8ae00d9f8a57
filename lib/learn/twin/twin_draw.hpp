// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/random.hpp"
#include "lib/learn/twin/twin.hpp"

namespace faultline {

/// Duration of a move, s, at which the twin is about as fast as the logs.
double usual_move_s(const Twin& twin);

// Each of these draws one part of a run.
MotionSpec draw_motion(const Twin& twin, Random& random);
/// PD control stabilises fewer robots than computed torque, so that a second attempt does not allow it.
ControllerSpec draw_controller(const Twin& twin, bool allow_pd, Random& random);
/// Differences of drive torque and logged torque in the normal range: offset, torque constant, roughness.
DriveSpec draw_drives(const Twin& twin, Random& random);
/// Measurement noise of a day, within the normal range.
NoiseSpec draw_noise(const Twin& twin, Random& random);
/// The robot with the friction of a day, within the normal range.
Robot draw_day(const Twin& twin, Robot robot, Random& random);
/// End stops outside the range of the logs, or none.
JointStops draw_stops(const Twin& twin, Random& random);
/// The requested fault, and for a kind that passes possibly a second push at another joint.
std::vector<SimulatedFault> draw_faults(const Twin& twin, const FaultLabel& label, double onset_s,
                                        Random& random);

}  // namespace faultline
