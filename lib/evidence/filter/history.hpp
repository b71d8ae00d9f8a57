// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lib/evidence/filter/follower.hpp"

namespace faultline {

/// The last samples of the follower, by their number since the start of the log, in storage that is reused.
class History {
 public:
  /// Keeps `capacity` samples, a power of two.
  explicit History(std::int64_t capacity) : samples_(capacity), mask_(capacity - 1) {}

  /// Storage for the next sample.
  FollowedSample& push() { return samples_[end_++ & mask_]; }
  const FollowedSample& operator[](std::int64_t number) const { return samples_[number & mask_]; }
  const FollowedSample& back() const { return samples_[(end_ - 1) & mask_]; }
  std::int64_t last() const { return end_ - 1; }
  std::int64_t first() const {
    return std::max<std::int64_t>(0, end_ - static_cast<std::int64_t>(samples_.size()));
  }
  std::int64_t capacity() const { return mask_ + 1; }

 private:
  std::vector<FollowedSample> samples_;
  std::int64_t mask_;
  std::int64_t end_ = 0;
};

}  // namespace faultline
