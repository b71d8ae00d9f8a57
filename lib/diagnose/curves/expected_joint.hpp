// SPDX-License-Identifier: MIT
#pragma once

#include "lib/log/log.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

/// What was expected of the healthy robot one step ahead, at the row where a prediction ends.
struct ExpectedJoint {
  double q = 0.0, dq = 0.0;  ///< rad or m and per s; dq is NaN without measured velocities
};

/// Of joint `joint` (from 0) by prediction `i` of `residuals`, which belongs to row `row` of the segment.
ExpectedJoint expected_joint(const HealthyResiduals& healthy, const Log& segment, int row,
                             const Residuals& residuals, int i, int joint);

}  // namespace faultline
