// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "lib/evidence/filter/follower.hpp"
#include "lib/evidence/learn/match_noise.hpp"

namespace faultline {

/// Follows an excerpt whose work pieces come and go as it says. Calls `visit` with every sample, and whether
/// a work piece came or went since the one before.
void follow_excerpt(const HealthyExcerpt& excerpt, const MotionModel& model,
                    const std::function<void(const FollowedSample& sample, bool changed)>& visit);

}  // namespace faultline
