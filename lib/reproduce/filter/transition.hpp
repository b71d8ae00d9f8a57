// SPDX-License-Identifier: MIT
#pragma once

#include "lib/reproduce/filter/fault_dynamics.hpp"
#include "lib/reproduce/filter/gaussian_state.hpp"

namespace faultline {

/// d(q, dq after the step) / d(state before), row by row, `size` numbers each; all else stays what it is.
using MotionRows = std::array<double, 2 * kMaxJoints * kMaxStates>;

/// The slow states and the fault sizes in a state vector, behind q and dq.
SizedFault circumstances(const StateVector& vector, const MotionModel& model, const Hypothesis* hypothesis,
                         std::span<const double> drive_level = {});

/// For short steps, from the friction slope and inverse inertia in `at`; the change of the rigid-body torque
/// with position and speed over a step is left out.
MotionRows analytic_transition(const GaussianState& state, const Acceleration& at, const MotionModel& model,
                               double dt, const Hypothesis* hypothesis);

/// For any step: the product of those of substeps, each with the slopes of the acceleration in its middle (by
/// differences) and the implicit trapezoidal rule, which friction of any stiffness leaves stable.
MotionRows stepwise_transition(const StateVector& before, int size, const MotionModel& model,
                               const FaultDynamics& dynamics, const JointArray& torque,
                               std::span<const double> drive_level, double dt, const Hypothesis* hypothesis);

}  // namespace faultline
