// SPDX-License-Identifier: MIT
#pragma once

#include "lib/log/log.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {

/// The state that was predicted one step ahead for the healthy robot, at the row where the prediction ends.
struct ExpectedJoint {
  double q = 0.0, dq = 0.0;  ///< rad or m and per s; dq is NaN without measured velocities
};

/// Returns prediction `i` of `residuals` for joint `joint` (from 0); it ends at row `row` of the segment.
ExpectedJoint expected_joint(const HealthyResiduals& healthy, const Log& segment, int row,
                             const Residuals& residuals, int i, int joint);

}  // namespace faultline
