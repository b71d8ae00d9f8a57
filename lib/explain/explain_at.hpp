// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lib/explain/explain_log.hpp"

namespace faultline {

/// Returns the fault of a log that is known to begin at `onset_s` and to end at `end_s` (kNeverEnds for one
/// that lasts): judges every kind at every joint with these times, without a search. Empty if no kind exceeds
/// its limit. For logs with known truth, from which networks and cases learn.
std::optional<ExplainedFault> explain_at(const UniformLog& log, const ExplainModel& model, double onset_s,
                                         double end_s);

}  // namespace faultline
