// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "lib/reproduce/filter/follower.hpp"
#include "lib/reproduce/filter/match_noise.hpp"

namespace faultline {

/// Follows an excerpt and calls `visit` with every sample.
void follow_excerpt(const HealthyExcerpt& excerpt, const MotionModel& model,
                    const std::function<void(const FollowedSample& sample)>& visit);

}  // namespace faultline
