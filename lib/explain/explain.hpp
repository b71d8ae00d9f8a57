// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "lib/explain/evidence_course.hpp"
#include "lib/explain/free_form.hpp"
#include "lib/explain/hypothesis.hpp"

namespace faultline {

/// What one log says: the best hypothesis of each kind and joint, best first; none where nothing stands out.
struct LogExplanation {
  std::vector<FaultHypothesis> best;
  double healthy_square = 1.0;  ///< mean square of what the healthy robot leaves, in standard deviations
  FreeForm free_form;
  double free_gain = 0.0;  ///< nats by which that explains the log better than the healthy robot
};

/// Where the search finds nothing that may give `least_evidence` (nats), no hypothesis is judged.
LogExplanation explain_log(const LogFit& fit, double least_evidence = 0.0);

/// A log beside known faults, and what it says.
struct ExplainedFit {
  LogFit fit;
  LogExplanation explanation;
};
/// The same with the noise that the log has beside its best explanation. Before anything is known of a fault
/// that begins early, it makes the log loud: what the effects of the day leave of it counts as noise.
/// `explain` gives the explanation of a fit, such as explain_log().
ExplainedFit explain_with_own_noise(const UniformLog& log, const BalanceModel& model,
                                    const std::vector<FaultClaim>& known,
                                    const std::function<LogExplanation(const LogFit&)>& explain);

/// Nats by which a change of any form explains the log better than a hypothesis: no fault has exactly the
/// form of its columns, so a share of its torque is noise.
double misfit(const LogFit& fit, const FreeForm& change, const FaultHypothesis& hypothesis);

/// Evidence of `hypothesis` from its onset on; the effects of the day are those of the whole log.
EvidenceCourse evidence_course(const LogFit& fit, const FaultHypothesis& hypothesis);

}  // namespace faultline
