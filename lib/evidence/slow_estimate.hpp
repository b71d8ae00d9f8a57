// SPDX-License-Identifier: MIT
#pragma once

#include "lib/evidence/slow_state.hpp"

namespace faultline {

/// What a log tells of a slow state, at its end or when the first fault came.
struct SlowEstimate {
  SlowState state;
  double value = 0.0;  ///< against the robot that was identified; of the tip's mass without work pieces
  double std = 0.0;
};

}  // namespace faultline
