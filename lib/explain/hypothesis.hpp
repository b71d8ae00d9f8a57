// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/explain/log_fit.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// A fault that may explain a log, judged exactly.
struct FaultHypothesis {
  FaultKind kind = FaultKind::none;
  int joint = 0;  ///< from 1
  double onset_s = 0.0;
  double duration_s = 0.0;  ///< of a collision; else 0: to the end of the log
  double gain = 0.0;        ///< nats by which it explains the log better than the healthy robot
  Eigen::VectorXd size;  ///< of its columns; of a sensor fault the shift (rad or m) or drift (rad/s or m/s)
  Explanation fit;
};

}  // namespace faultline
