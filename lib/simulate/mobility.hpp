// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/fast_dynamics.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Largest acceleration that one unit of torque at a joint gives it over some postures: the diagonal of M^-1,
/// (rad/s^2)/(N m) or (m/s^2)/N, for each joint.
JointVector mobility(const FastDynamics& dynamics);

/// Largest slope of the friction torque over the speed of a sliding joint, N m s/rad or N s/m; Coulomb
/// friction is constant there. Its product with the mobility is the rate, 1/s, at which friction slows the
/// joint.
double sliding_slope(const Friction& friction);

/// Returns the robot with the least additional rotor inertia for which sliding friction takes at least
/// `slowest_s` to slow any joint by the factor e. Identification hardly determines the inertia of a light
/// wrist beside its friction; a value near zero would need simulation steps of microseconds and change no
/// logged torque.
Robot with_slow_friction(Robot robot, double slowest_s);

}  // namespace faultline
