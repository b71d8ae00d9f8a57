// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/residual/transitions.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

struct TwinPatternOptions {
  double position_spread =
      0.3;  ///< standard deviations added to the logged starts, as a share of half the range
  double velocity_spread = 0.3;
  double torque_spread = 0.4;
  std::uint64_t seed = 1;
};

/// Simulates `count` transitions of the identified robot from starts scattered around `logged` ones, so that
/// a network also learns the states between and beyond the moves of a few healthy logs, which a faulty robot
/// reaches. Throws nothing; transitions with non-finite results are left out.
Transitions twin_transitions(const Transitions& logged, const TransitionShape& shape, const Chain& chain,
                             int count, const TwinPatternOptions& options = {});

}  // namespace faultline
