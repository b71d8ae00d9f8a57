// SPDX-License-Identifier: MIT
#pragma once

#include "lib/reproduce/filter/prediction.hpp"

namespace faultline {

/// Adds what the model misses over the step (ProcessNoise) to the covariance of q and dq. `at` gives the
/// inverse inertia that turns torque into acceleration.
void add_process_noise(GaussianState& state, const Acceleration& at, const MotionModel& model,
                       const Step& step);

/// A torque that jumps winds up the spring of its gear, and the reading moves with it.
void allow_springs(GaussianState& state, const MotionModel& model, const Step& step);

/// A joint that an end stop may hold: its velocity may have been stopped or turned within the step.
void allow_end_stops(GaussianState& state, const MotionModel& model, const Step& step);

}  // namespace faultline
