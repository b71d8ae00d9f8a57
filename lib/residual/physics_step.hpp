// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

struct JointState {
  JointVector q;
  JointVector dq;
};

/// The state `duration` seconds later under constant torque, by Runge-Kutta steps of order 4 that are at most
/// 5 ms long and short enough for its friction near zero velocity. NaN in any input gives NaN.
JointState physics_step(const FastDynamics& robot, const JointState& start, const JointVector& tau,
                        double duration);

}  // namespace faultline
