// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "lib/reproduce/filter/follower.hpp"

namespace faultline {

/// The last samples of the follower, by their number since the start of the log, in storage that is reused
/// and taken as far as the log goes: a sample is large and many logs are short.
class History {
 public:
  /// Keeps `capacity` samples, a power of two of at least a block.
  explicit History(std::int64_t capacity)
      : blocks_(static_cast<std::size_t>(capacity / kBlock)), mask_(capacity - 1) {}

  /// Storage for the next sample.
  FollowedSample& push() {
    std::unique_ptr<FollowedSample[]>& block = blocks_[(end_ & mask_) / kBlock];
    if (!block) block = std::make_unique<FollowedSample[]>(kBlock);
    return block[end_++ % kBlock];
  }
  const FollowedSample& operator[](std::int64_t number) const {
    return blocks_[(number & mask_) / kBlock][number % kBlock];
  }
  const FollowedSample& back() const { return (*this)[end_ - 1]; }
  std::int64_t last() const { return end_ - 1; }
  std::int64_t first() const { return std::max<std::int64_t>(0, end_ - capacity()); }
  std::int64_t capacity() const { return mask_ + 1; }

 private:
  static constexpr std::int64_t kBlock = 64;

  std::vector<std::unique_ptr<FollowedSample[]>> blocks_;
  std::int64_t mask_;
  std::int64_t end_ = 0;
};

}  // namespace faultline
