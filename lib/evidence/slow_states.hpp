// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/learn/match_noise.hpp"
#include "lib/evidence/motion_model.hpp"
#include "lib/log/log.hpp"
#include "lib/robot/normal_range.hpp"

namespace faultline {

/// The slow states of a robot whose days differ by the normal range, before anything was learned. `model` has
/// chain and scales. Coloured torques begin as a small share of the largest torque.
std::vector<SlowState> slow_states(const MotionModel& model, const NormalRange& normal);

/// Where the mass at the tip stands in a filter's state; -1 where it does not.
int tip_mass_index(const MotionModel& model);

/// Widens the doubt of each slow state to what the excerpts of healthy days show beyond it: random effects,
/// the expected square of the state given a day's log.
void widen_to_days(MotionModel& model, const std::vector<HealthyExcerpt>& days, int threads);

/// How a log of these rows, or of that level, measures against the model's logs.
LogNoise log_noise(const MotionModel& model, const Log& rows);

/// Raises each coloured torque to what the equations of motion miss at the least, `share` of the joint's
/// largest torque.
void allow_model_error(MotionModel& model, double share);

}  // namespace faultline
