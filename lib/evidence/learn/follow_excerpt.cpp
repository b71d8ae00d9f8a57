// SPDX-License-Identifier: MIT
#include "lib/evidence/learn/follow_excerpt.hpp"

namespace faultline {

void follow_excerpt(const HealthyExcerpt& excerpt, const MotionModel& model,
                    const std::function<void(const FollowedSample& sample, bool changed)>& visit) {
  FollowedSample sample;
  Follower follower(model, excerpt.noise);
  auto change = excerpt.work_piece_changes.begin();
  for (int k = 0; k < excerpt.log.rows(); ++k) {
    bool changed = false;
    for (; change != excerpt.work_piece_changes.end() && change->row <= excerpt.log.first_row + k; ++change) {
      follower.change_work_piece(change->kg);
      changed = true;
    }
    follower.follow(excerpt.log, k, sample);
    visit(sample, changed);
  }
}

}  // namespace faultline
