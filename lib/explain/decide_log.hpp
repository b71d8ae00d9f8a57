// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "lib/explain/explain.hpp"

namespace faultline {

/// Evidence in nats that a hypothesis of each kind needs to be believed.
struct EvidenceLimits {
  std::array<double, kFaultKinds> nats{};

  double of(FaultKind kind) const { return nats[static_cast<std::size_t>(kind)]; }
};

/// Limits from healthy logs, each explained by a model that was learned from the others: twice the evidence
/// that any of them gave for a kind, at least that of any kind, at least kLeastEvidence.
EvidenceLimits evidence_limits(const std::vector<LogExplanation>& healthy);

inline constexpr double kMuchLeft = 3.0;         ///< mean square from which an explanation may be none
inline constexpr double kUnexplained = 0.3;      ///< and share of what the log leaves without it
inline constexpr double kLeastEvidence = 100.0;  ///< nats; healthy days that no few logs show add some tens

/// All limits times `factor`.
EvidenceLimits scaled(EvidenceLimits limits, double factor);

/// The fault of a log.
struct ExplainedFault {
  FaultClaim claim;
  double alarm_s = 0.0;   ///< earliest sample at which the evidence from the onset on passes the limit
  double evidence = 0.0;  ///< nats
  double left = 1.0;      ///< mean square of what the explanation leaves, in standard deviations
  std::vector<FaultLabel> could_also_be;  ///< explain the log almost as well

  FaultLabel label() const { return {claim.kind, claim.joint}; }
};

/// When the evidence of a hypothesis, and of a change of any form, passes a limit in nats. Without
/// `of_free_form` an unknown fault has the onset and the alarm of the hypothesis that comes nearest.
struct AlarmTimes {
  std::function<double(const FaultHypothesis&, double)> of;
  std::function<double(double)> of_free_form{};
};

/// Those of rows of 50 Hz and more.
AlarmTimes alarm_times(const LogFit& fit, const LogExplanation& explanation);

/// The hypotheses that explain the log best and pass their limits, with their names: at most `most`, best
/// first.
std::vector<ExplainedFault> named_faults(const LogExplanation& explanation, const EvidenceLimits& limits,
                                         const AlarmTimes& alarms, std::size_t most);

/// A fault of no kind, which `named` comes nearest to.
ExplainedFault as_unknown(const ExplainedFault& named, const LogExplanation& explanation,
                          const EvidenceLimits& limits, const AlarmTimes& alarms);

/// Whether named faults explain so little that the fault is none of the kinds: `named` is the last of them,
/// `without` the mean square that the log leaves without any of them.
bool leaves_much(const ExplainedFault& named, double without);

/// The fault that explains the log best, or `unknown` where the best explanation leaves much more than noise.
/// Empty when no hypothesis passes its limit.
std::optional<ExplainedFault> decide_log(const LogExplanation& explanation, const EvidenceLimits& limits,
                                         const AlarmTimes& alarms);

}  // namespace faultline
