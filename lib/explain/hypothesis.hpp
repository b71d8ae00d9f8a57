// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <utility>

#include "lib/explain/log_fit.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// A fault that may explain a log, judged exactly (equation (6) of docs/how-it-works.md).
struct FaultHypothesis : FaultClaim {
  double gain = 0.0;  ///< nats by which it explains the log better than the known faults alone
  /// Part of `gain` that comes from the measurements at the onset, not from the torque-balance rows.
  double at_onset = 0.0;
  Explanation fit{};
};

/// Returns the hypothesis of a claim with its explanation; `price`: nats that it costs beside its residuals.
inline FaultHypothesis hypothesis(const LogFit& fit, const FaultClaim& claim, Explanation explanation,
                                  double price) {
  FaultHypothesis out{claim};
  out.gain = explanation.log_likelihood - price - fit.healthy().log_likelihood;
  out.size = explanation.size;
  out.fit = std::move(explanation);
  return out;
}

}  // namespace faultline
