// SPDX-License-Identifier: MIT
#pragma once

#include "lib/residual/transitions.hpp"
#include "lib/robot/chain.hpp"
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

/// Simulates `count` transitions of the identified robot from starts scattered around `logged` ones, so that
/// a network also learns the states between and beyond the moves of a few healthy logs, which a faulty robot
/// reaches. Throws nothing; transitions with non-finite results are left out.
Transitions twin_transitions(const Transitions& logged, const TransitionShape& shape, const Chain& chain,
                             int count);

}  // namespace faultline
