// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
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

inline constexpr double kUsualBlow_s = 0.05;   ///< median of the length of a collision
inline constexpr double kLongestBlow_s = 1.2;  ///< of a collision: a longer force is another fault
inline constexpr double kUsualStay_s = 20.0;   ///< mean length of another fault that ends

/// Returns the nats of the length of a fault that ends, against a length of 0 for a collision: the density of
/// a collision's length falls with its square, that of other faults is flat up to their mean length.
inline double price_of_length(const FaultClaim& claim) {
  if (claim.end_s >= kNeverEnds) return 0.0;
  return claim.kind == FaultKind::collision
             ? 2.0 * elementary::log1p((claim.end_s - claim.onset_s) / kUsualBlow_s)
             : elementary::log(kUsualStay_s / kUsualBlow_s);
}

/// Returns the hypothesis of a claim with its explanation; `price`: nats that it costs beside its residuals
/// and its length.
inline FaultHypothesis hypothesis(const LogFit& fit, const FaultClaim& claim, Explanation explanation,
                                  double price) {
  FaultHypothesis out{claim};
  out.gain = explanation.log_likelihood - price - price_of_length(claim) - fit.healthy().log_likelihood;
  out.size = explanation.size;
  out.fit = std::move(explanation);
  return out;
}

}  // namespace faultline
