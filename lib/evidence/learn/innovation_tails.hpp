// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/learn/match_noise.hpp"

namespace faultline {

/// Sets MotionModel::q_tail and dq_tail where healthy innovations stray much farther than a normal
/// distribution does. Returns whether any does.
bool learn_tails(MotionModel& model, const std::vector<HealthyExcerpt>& excerpts, int threads);

}  // namespace faultline
