// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "lib/explain/explain.hpp"

namespace faultline {

/// Evidence in nats that a hypothesis of each kind needs to be believed.
struct EvidenceLimits {
  std::array<double, kFaultKinds> nats{};

  /// A drive that clips is an unknown fault, and healthy logs that resemble a lost torque resemble it, too.
  double of(FaultKind kind) const {
    const double own = nats[static_cast<std::size_t>(kind)];
    return kind == FaultKind::unknown ? std::max(own, of(FaultKind::torque_loss)) : own;
  }
};

/// Limits from healthy logs (equation (8) of docs/how-it-works.md), each explained by a model that was
/// learned from the others: thrice the evidence that any of them gave for a kind, at least that of any kind,
/// at least kLeastEvidence. The evidence for an unknown fault is that of a change of any form.
EvidenceLimits evidence_limits(const std::vector<LogExplanation>& healthy);

inline constexpr double kLeastLoss = 0.08;  ///< share of the torque: less is the gain of another day

inline constexpr double kAlmostShare = 0.95;  ///< of the best evidence: as good as the best

inline constexpr double kLeastEvidence = 100.0;  ///< nats; days unlike the few logged give some tens

/// The least evidence with which a fault of any kind is believed.
double least_limit(const EvidenceLimits& limits);

/// All limits times `factor`.
EvidenceLimits scaled(EvidenceLimits limits, double factor);

/// What a hypothesis of one kind and joint says of a log.
struct LabelScore {
  FaultClaim claim;
  double nats = 0.0;  ///< by which it explains the log better than what is known of it without
  double left = 1.0;  ///< mean square of what it leaves, in variances of the noise

  FaultLabel label() const { return claim.label(); }
};

/// The fault of a log.
struct ExplainedFault {
  FaultClaim claim;
  double alarm_s = 0.0;   ///< earliest sample at which the evidence from the onset on passes the limit
  double evidence = 0.0;  ///< nats
  double limit = 0.0;     ///< nats that it had to pass
  double misfit = 0.0;    ///< nats by which a change of any form explains the log better
  /// Of the mean square over that of the noise that the log leaves without the fault, the share with it.
  double left_share = 0.0;
  std::vector<FaultLabel> could_also_be;  ///< explain the log almost as well
  std::vector<LabelScore> scores;         ///< of each kind and joint that was judged, best first
  EvidenceTrace trace;                    ///< of the best of them

  FaultLabel label() const { return claim.label(); }
};

/// Limits that are at least kBeyondSimulated times the evidence that a fault of a healthy log gave, of each
/// kind that was judged.
EvidenceLimits above_false_alarm(EvidenceLimits limits, const ExplainedFault& fault);

inline constexpr double kBeyondSimulated = 1.5;  ///< times: there are more simulated logs than recorded ones

/// What decides about the hypotheses of a log: how the evidence of one, and of a change of any form, grows,
/// and how much better a change of any form explains the log. Without `course_of_free_form` an unknown fault
/// has the onset and the alarm of the hypothesis that comes nearest.
struct LogEvidence {
  std::function<EvidenceCourse(const FaultHypothesis&)> course;
  std::function<double(const FaultHypothesis&)> misfit;
  std::function<EvidenceCourse()> course_of_free_form{};
};

/// That of rows of 50 Hz and more.
LogEvidence log_evidence(const LogFit& fit, const LogExplanation& explanation);

/// The hypotheses that explain the log best and pass their limits, with their names: at most `most`, best
/// first.
std::vector<ExplainedFault> named_faults(const LogExplanation& explanation, const EvidenceLimits& limits,
                                         const LogEvidence& evidence, std::size_t most);

/// A fault of no kind, which `named` comes nearest to.
ExplainedFault as_unknown(const ExplainedFault& named, const LogExplanation& explanation,
                          const LogEvidence& evidence);

/// A fault of no kind where no hypothesis passes its limit: a change of any form explains the log better than
/// the healthy robot, by more than its own limit and than kOfNoKind.
std::optional<ExplainedFault> unnamed_fault(const LogExplanation& explanation, const EvidenceLimits& limits,
                                            const LogEvidence& evidence);

inline constexpr double kOfNoKind = 200.0;  ///< nats by which a change of any form explains much more

/// Whether a change of any form explains the log so much better that a further fault or none of the kinds
/// may.
bool leaves_much(const ExplainedFault& named);

/// Whether the fault alone explains the log: it leaves little, or it is a halt that leaves a small share of a
/// great deal: a joint that halts shakes the robot in ways that no column has, such as on soft springs.
bool suffices(const ExplainedFault& named);

/// The fault that explains the log best, or `unknown` where a change of any form explains much more.
/// Empty when no hypothesis passes its limit.
std::optional<ExplainedFault> decide_log(const LogExplanation& explanation, const EvidenceLimits& limits,
                                         const LogEvidence& evidence);

}  // namespace faultline
