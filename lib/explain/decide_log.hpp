// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "lib/explain/evidence_score.hpp"
#include "lib/explain/explain.hpp"

namespace faultline {

/// Evidence in nats that a hypothesis of each kind must exceed to be reported.
struct EvidenceLimits {
  std::array<double, kFaultKinds> nats{};

  /// Returns the limit of a kind. That of an unknown fault is at least that of a torque loss: a drive that
  /// clips is an unknown fault, and healthy logs that resemble a torque loss resemble it, too.
  double of(FaultKind kind) const {
    const double own = nats[static_cast<std::size_t>(kind)];
    return kind == FaultKind::unknown ? std::max(own, of(FaultKind::torque_loss)) : own;
  }
};

/// Returns limits from healthy logs (equation (8) of docs/how-it-works.md), each explained by a model that
/// was learned from the others: three times the largest evidence for the kind, at least the largest evidence
/// for any kind (for a collision, in rows that one push can reach), at least kLeastEvidence. For an unknown
/// fault, the evidence of the free form counts, too.
EvidenceLimits evidence_limits(const std::vector<LogExplanation>& healthy);

inline constexpr double kLeastLoss = 0.08;  ///< share of the torque: less may be the gain of another day

inline constexpr double kAlmostShare = 0.95;  ///< share of the best evidence that is as good as the best

inline constexpr double kLeastEvidence = 100.0;  ///< nats; days unlike the few recorded ones give some tens

/// Returns the least limit of all kinds, nats.
double least_limit(const EvidenceLimits& limits);

/// Returns all limits times `factor`.
EvidenceLimits scaled(EvidenceLimits limits, double factor);

/// Evidence of a hypothesis of one kind and joint on a log.
struct LabelScore {
  FaultClaim claim;
  double nats = 0.0;  ///< by which it explains the log better than the known faults alone
  double left = 1.0;  ///< mean square of its residuals, in variances of the noise

  FaultLabel label() const { return claim.label(); }
};

/// A fault that explains a log.
struct ExplainedFault {
  FaultClaim claim;
  double alarm_s = 0.0;    ///< earliest sample at which the evidence from the onset on passes the limit
  double evidence = 0.0;   ///< nats
  double limit = 0.0;      ///< nats that the evidence had to exceed
  double misfit = 0.0;     ///< nats by which a free form explains the log better
  double shrinking = 0.0;  ///< price_of_shrinking(): a part of `misfit` that no further fault takes away
  /// Excess of the mean square of the residuals over the noise, as a share of that without the fault.
  double residual_share = 0.0;
  std::vector<FaultLabel> could_also_be;  ///< explain the log almost as well
  std::vector<LabelScore> scores;         ///< of each kind and joint that was judged, best first
  EvidenceTrace trace;                    ///< of the best of them

  FaultLabel label() const { return claim.label(); }
};

/// Returns the score of a log that the healthy robot should explain.
EvidenceScore score_of(const LogExplanation& explanation, const EvidenceLimits& limits);

/// Returns the score that a fault gives its log.
EvidenceScore score_of(const ExplainedFault& fault);

/// Returns the limits, raised to at least kBeyondSimulated times the evidence that a healthy log with the
/// false finding `fault` gave for each kind that was judged.
EvidenceLimits above_false_alarm(EvidenceLimits limits, const ExplainedFault& fault);

inline constexpr double kBeyondSimulated = 1.5;  ///< factor; there are more simulated logs than recorded ones

/// Returns the best hypotheses that exceed their limits as faults: at most `most`, best first.
std::vector<ExplainedFault> named_faults(const LogExplanation& explanation, const EvidenceLimits& limits,
                                         std::size_t most);

/// Returns a fault of no known kind to which `named` is the nearest one, with onset and alarm of the free
/// form; with its own at coarse rates.
ExplainedFault as_unknown(const ExplainedFault& named, const LogExplanation& explanation);

/// Returns a fault of no known kind for a log without a hypothesis above its limit. Empty unless a free form
/// explains the log better than the healthy robot by more than its own limit and kOfNoKind.
std::optional<ExplainedFault> unnamed_fault(const LogExplanation& explanation, const EvidenceLimits& limits);

inline constexpr double kOfNoKind = 200.0;  ///< nats of misfit above which a fault may be of no known kind

/// Returns whether the misfit of a fault is so large that there may be a further fault, or one of no known
/// kind; never for a stuck encoder.
bool has_large_misfit(const ExplainedFault& named);

/// Returns whether the fault alone explains the log: its misfit is small, or it is a lock with residuals that
/// are a small share of those without it. A joint that halts shakes the robot in ways that no column
/// describes, such as on soft springs.
bool suffices(const ExplainedFault& named);

/// Returns the fault that explains the log best, as `unknown` if it does not suffice. If no hypothesis
/// exceeds its limit, returns that of unnamed_fault(), if any.
std::optional<ExplainedFault> decide_log(const LogExplanation& explanation, const EvidenceLimits& limits);

}  // namespace faultline
