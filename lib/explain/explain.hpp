// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "lib/explain/free_form.hpp"
#include "lib/explain/hypothesis.hpp"

namespace faultline {

/// Explanation of a log by the best hypothesis of each kind and joint, best first; none if none stands out.
struct LogExplanation {
  std::vector<FaultHypothesis> best;
  /// The nearest hypotheses of a log in which none stands out: for its score alone, without course and
  /// misfit.
  std::vector<FaultHypothesis> quiet{};
  double healthy_square = 1.0;  ///< mean square of the whitened residuals of the healthy robot
  // At coarse rates there is no free form: a hypothesis whose residuals are much larger than noise has an
  // infinite misfit.
  FreeForm free_form;
  double free_gain = 0.0;  ///< nats by which the free form explains the log better than the healthy robot
  /// Largest evidence of any hypothesis in the rows of one stretch as long as the longest push, nats: a push
  /// can explain no more of what a log leaves over. At coarse rates, that in all rows.
  double most_of_a_push = 0.0;
  EvidenceCourse free_course{};  ///< of the free form, from its onset on: excess of its residuals over noise
};

/// Explains a log. Judges no hypothesis if the search finds none that may give `least_evidence` (nats).
LogExplanation explain_log(const LogFit& fit, double least_evidence = 0.0);

/// Returns the explanation with misfit and course of its hypotheses, and the course of its free form.
LogExplanation with_evidence(const LogFit& fit, LogExplanation explanation);

/// A log with known faults, and its explanation.
struct ExplainedFit {
  LogFit fit;
  LogExplanation explanation;
};
/// Explains a log with the noise that it has beside its best explanation: until a fault that begins early is
/// known, its residuals beside the effects of the day count as noise. `explain` returns the explanation of a
/// fit, such as explain_log().
ExplainedFit explain_with_own_noise(const UniformLog& log, const BalanceModel& model,
                                    const std::vector<FaultClaim>& known,
                                    const std::function<LogExplanation(const LogFit&)>& explain);

/// Returns the nats by which a free form explains the log better than a hypothesis. A share of the torque of
/// the fault counts as noise, since no fault has exactly the form of its columns.
double misfit(const LogFit& fit, const FreeForm& change, const FaultHypothesis& hypothesis);

}  // namespace faultline
