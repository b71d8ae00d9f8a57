// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/identify/verdict/joint_fit.hpp"

namespace faultline {

/// What the torque that a joint's model leaves repeats with. Shares are of its variance over the windows in
/// which the joint moves, 0 to 1; NaN with too few windows.
struct ResidualPattern {
  double position = 0.0;  ///< told by bins of q
  double speed = 0.0;     ///< by bins of dq
  double torque = 0.0;    ///< by bins of the modelled torque
  double previous = 0.0;  ///< by its own value one window earlier
  std::vector<double> spectrum_hz;
  std::vector<double> spectrum;  ///< rms in the band about each frequency, N m or N; all logs together
};

/// Bins are fitted to half of the stretches of time and judged on the other half, both ways, so that many
/// bins explain nothing by chance.
ResidualPattern residual_pattern(const JointFit& fit);

}  // namespace faultline
