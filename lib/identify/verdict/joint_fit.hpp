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

}  // namespace faultline
