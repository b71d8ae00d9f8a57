// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <utility>

#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/evidence_course.hpp"
#include "lib/explain/log_fit.hpp"
#include "lib/fault/fault_kind.hpp"

namespace faultline {

// Prices and limits of hypotheses beside their columns: the same at fine and at coarse rates. Prices are
// natural logarithms of prior probabilities (nats).

inline constexpr double kNoSuchSize = 1e9;  ///< price of a size that no fault of the kind has
inline constexpr double kMostLoss = 1.2;    ///< share of the torque: a larger loss is an error of the fit
inline constexpr double kBeyondLoss = 2e4;  ///< price for each share lost beyond all torque or load
inline constexpr double kStillJoint = 3.0;  ///< price of a joint, or of a position, that does not move
inline constexpr double kForcedRow = 1.2;   ///< price of each row that an unknown force explains
inline constexpr double kRepeatedReading = 2.0;  ///< price of each repeated position of a locked joint
inline constexpr int kMostRepeats = 500;         ///< repeated positions that count for a stuck encoder
inline constexpr double kStuckShare = 0.98;      ///< least share of positions that a stuck encoder repeats
inline constexpr double kFreeShare = 0.9;        ///< share of the torque lost: more is a free joint
inline constexpr double kFormShare = 0.05;  ///< share of its effect that a known (no unknown) fault may miss

inline constexpr double kLead_s = 0.5;  ///< at the start of a log, in which no onset is searched,
inline constexpr int kLeadRows = 6;     ///< or rows, whichever is longer

inline constexpr double kStandsOut = 8.0;      ///< nats from which an onset stands out
inline constexpr double kWorthRefining = 5.0;  ///< nats from which an onset is refined
inline constexpr double kMayWin = 0.3;         ///< share of the best evidence below which none is refined

/// A fault that may explain a log, judged exactly (equation (6) of docs/how-it-works.md).
struct FaultHypothesis : FaultClaim {
  /// Nats by which it explains the log better than the known faults alone.
  double gain = -std::numeric_limits<double>::infinity();
  /// Part of `gain` that comes from the measurements at the onset, not from the torque-balance rows.
  double at_onset = 0.0;
  /// Price that `gain` contains by price_of_shrinking(): `misfit` contains it, too, and no further fault
  /// takes it away.
  double shrinking = 0.0;
  Explanation fit{};

  // Of the best hypothesis of each kind and joint alone.
  EvidenceCourse course{};  ///< from the onset on
  double misfit = 0.0;      ///< nats by which a free form explains the log better
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
