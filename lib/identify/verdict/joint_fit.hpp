// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace faultline {

/// What moved one joint and what the model says should have, window by window, in the order of logs and time.
struct JointFit {
  double window_s = 0.0;                   ///< length of a window; each lies half over the last
  std::vector<int> log;                    ///< from 0
  std::vector<double> time_s;              ///< start of the window
  std::vector<double> q, dq;               ///< in its middle
  std::vector<double> measured, modelled;  ///< mean torque, N m or N
  std::vector<double> friction;            ///< the part of `modelled` that is friction
  std::vector<bool> moving;                ///< false where the joint rests: such windows are not fitted to

  std::size_t size() const { return log.size(); }
  double residual(std::size_t k) const { return measured[k] - modelled[k]; }
};

}  // namespace faultline
