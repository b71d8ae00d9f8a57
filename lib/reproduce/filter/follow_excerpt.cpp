// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/follow_excerpt.hpp"

namespace faultline {

void follow_excerpt(const HealthyExcerpt& excerpt, const MotionModel& model,
                    const std::function<void(const FollowedSample& sample)>& visit) {
  FollowedSample sample;
  Follower follower(model, excerpt.noise);
  for (int k = 0; k < excerpt.log.rows(); ++k) {
    follower.follow(excerpt.log, k, sample);
    visit(sample);
  }
}

}  // namespace faultline
