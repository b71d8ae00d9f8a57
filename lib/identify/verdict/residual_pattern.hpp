// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/verdict/joint_fit.hpp"

namespace faultline {

/// Quantities that predict a joint's torque residual. Shares are of its variance over the windows in which
/// the joint moves, 0 to 1; NaN with too few windows.
struct ResidualPattern {
  double position = 0.0;  ///< explained by bins of q
  double speed = 0.0;     ///< by bins of dq
  double torque = 0.0;    ///< by bins of the modelled torque
  double previous = 0.0;  ///< by its own value one window earlier
  std::vector<double> spectrum_hz;
  std::vector<double> spectrum;  ///< rms in the band of each frequency, N m or N; all logs together
};

/// Returns the pattern. Bins are fitted to half of the time stretches and judged on the other half, both
/// ways, so that many bins explain nothing by chance.
ResidualPattern residual_pattern(const JointFit& fit);

}  // namespace faultline
