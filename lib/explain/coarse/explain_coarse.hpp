// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/coarse/coarse_log.hpp"
#include "lib/explain/decide_log.hpp"

namespace faultline {

/// Explains a log at a coarse rate: the best hypothesis of each kind and joint, best first.
LogExplanation explain_coarse(const CoarseLog& log);

/// Follows a fault of an earlier part of the log that lasts when this one begins. Returns it with its new
/// size and its end, if the log shows one: its first sample if the evidence for it is at most `limit` (nats).
FaultClaim followed_coarse(const CoarseLog& log, FaultClaim lasting, double limit);

/// Returns the functions that decide on the hypotheses of a log at a coarse rate. A misfit is infinite if the
/// residuals are too large for a fault of a known kind, else 0.
LogEvidence coarse_evidence(const CoarseLog& log, const LogExplanation& explanation);

}  // namespace faultline
