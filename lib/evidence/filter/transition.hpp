// SPDX-License-Identifier: MIT
#pragma once

#include "lib/evidence/filter/fault_dynamics.hpp"
#include "lib/evidence/filter/gaussian_state.hpp"

namespace faultline {

/// d(state after the step) / d(state before), row by row, `size` numbers each.
using Transition = std::array<double, kMaxStates * kMaxStates>;

/// Steps up to this long (s) take the analytic transition, longer ones the numeric.
inline constexpr double kAnalyticStep_s = 0.012;

/// For short steps, from the friction slope and inverse inertia in `at`; the change of the rigid-body torque
/// with position and speed over a step is left out. `each_joint_has_a_size` when the sizes are torques, one a
/// joint.
Transition analytic_transition(const GaussianState& state, const Acceleration& at, int n, double dt,
                               bool each_joint_has_a_size);

/// For any step, by differences of an integration that is coarser than that of the mean, which a derivative
/// can bear.
Transition numeric_transition(const GaussianState& before, const MotionModel& model,
                              const FaultDynamics& dynamics, const JointArray& torque, double dt,
                              const Hypothesis* hypothesis);

}  // namespace faultline
