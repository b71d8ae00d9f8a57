// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/explain/log_fit.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// A fault that may explain a log, judged exactly.
struct FaultHypothesis : FaultClaim {
  double gain = 0.0;  ///< nats by which it explains the log better than what is known of it without
  Explanation fit{};
};

}  // namespace faultline
