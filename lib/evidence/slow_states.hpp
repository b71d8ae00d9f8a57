// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/match_noise.hpp"
#include "lib/evidence/motion_model.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/normal_range.hpp"

namespace faultline {

/// The slow states of a robot whose days differ by the normal range, before anything was learned. `model` has
/// chain and scales. Coloured torques begin as a small share of the largest torque.
std::vector<SlowState> slow_states(const MotionModel& model, const NormalRange& normal);

/// Widens the doubt of each slow state to what the excerpts of healthy days show beyond it: random effects,
/// the expected square of the state given a day's log.
void widen_to_days(MotionModel& model, const std::vector<HealthyExcerpt>& days, int threads);

/// How a log of these rows, or of that level, measures against the model's logs.
LogNoise log_noise(const MotionModel& model, const Log& rows);

/// The same of a log that is not judged yet, from its first rows. Rewinds the log before and after.
LogNoise survey_noise(LogSource& log, const MotionModel& model);

}  // namespace faultline
