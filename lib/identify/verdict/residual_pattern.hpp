// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace faultline {

/// Measured and modelled torque of one joint, window by window, in the order of logs and time.
struct JointFit {
  double window_s = 0.0;                   ///< length of a window; each overlaps half of the previous one
  std::vector<int> log;                    ///< from 0
  std::vector<double> time_s;              ///< start of the window
  std::vector<double> q, dq;               ///< in the middle of the window
  std::vector<double> measured, modelled;  ///< mean torque, N m or N
  std::vector<double> friction;            ///< viscous and Coulomb friction and offset in `modelled`
  std::vector<bool> moving;                ///< false if the joint rests: such windows are not fitted

  std::size_t size() const { return log.size(); }
  double residual(std::size_t k) const { return measured[k] - modelled[k]; }
};

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
