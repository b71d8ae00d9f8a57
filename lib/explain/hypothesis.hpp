// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <utility>

#include "lib/explain/log_fit.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

/// A fault that may explain a log, judged exactly (equation (6) of docs/how-it-works.md).
struct FaultHypothesis : FaultClaim {
  double gain = 0.0;  ///< nats by which it explains the log better than what is known of it without
  /// Part of `gain` that the readings at the onset give beside the rows of the torque balance.
  double at_onset = 0.0;
  Explanation fit{};
};

/// The hypothesis of a claim as an explanation gives it; it costs `price` nats beside what it leaves.
inline FaultHypothesis hypothesis(const LogFit& fit, const FaultClaim& claim, Explanation explanation,
                                  double price) {
  FaultHypothesis out{claim};
  out.gain = explanation.log_likelihood - price - fit.healthy().log_likelihood;
  out.size = explanation.size;
  out.fit = std::move(explanation);
  return out;
}

}  // namespace faultline
