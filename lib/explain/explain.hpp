// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/hypothesis.hpp"

namespace faultline {

/// A change of any form: the log is explained up to a moment, and nothing is said of what follows.
struct FreeForm {
  double onset_s = 0.0;
  Stacked left;  ///< whitened rows left over, with the effects of the day that the rows before the onset show
};

/// What one log says: the best hypothesis of each kind and joint, best first.
struct LogExplanation {
  std::vector<FaultHypothesis> best;
  double healthy_square = 1.0;  ///< mean square of what the healthy robot leaves, in standard deviations
  FreeForm free_form;
  bool slips = false;  ///< an encoder that jumps again and again: no single offset
};

LogExplanation explain_log(const LogFit& fit);

/// When what the rows before a change cannot explain passes `threshold` nats.
double alarm_time(const LogFit& fit, const FreeForm& change, double threshold);

/// When the evidence of `hypothesis` from its onset on passes `threshold`; the effects of the day are those
/// of the whole log.
double alarm_time(const LogFit& fit, const FaultHypothesis& hypothesis, double threshold);

}  // namespace faultline
