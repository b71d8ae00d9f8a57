// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/core/random.hpp"
#include "lib/residual/transitions.hpp"

namespace faultline {

/// At most `capacity` transitions drawn at random, each with the same chance, from a stream of any length
/// (reservoir sampling, Vitter 1985).
class TransitionReservoir {
 public:
  TransitionReservoir(int capacity, std::uint64_t seed) : capacity_(capacity), random_(seed) {}

  /// Offers one column of `transitions`.
  void offer(const Transitions& transitions, int column);
  /// Returns the transitions drawn so far.
  Transitions drawn() const;
  std::int64_t offered() const { return offered_; }

 private:
  int capacity_;
  Random random_;
  std::int64_t offered_ = 0;
  int kept_ = 0;
  Transitions pool_;
};

}  // namespace faultline
