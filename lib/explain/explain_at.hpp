// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lib/explain/explain_log.hpp"

namespace faultline {

/// The fault of a log that is known to begin at `onset_s` and to end at `end_s` (kNeverEnds for one that
/// lasts): every kind at every joint is judged with these times and nothing is searched. Empty when no kind
/// passes its limit. For logs whose truth is known: those that networks and cases learn from.
std::optional<ExplainedFault> explain_at(const UniformLog& log, const ExplainModel& model, double onset_s,
                                         double end_s);

}  // namespace faultline
