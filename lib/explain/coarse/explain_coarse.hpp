// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/coarse/coarse_log.hpp"
#include "lib/explain/decide_log.hpp"

namespace faultline {

/// What a log at a coarse rate says: the best hypothesis of each kind and joint, best first.
LogExplanation explain_coarse(const CoarseLog& log);

/// A fault that lasted when the log began, as an earlier part of it has shown: with its end where the log
/// shows one, at the log's first sample where it shows nothing of the fault that passes `limit` (nats).
FaultClaim followed_coarse(const CoarseLog& log, FaultClaim lasting, double limit);

/// What decides about the hypotheses of a log at a coarse rate. A hypothesis leaves so much that the fault is
/// none of the kinds, or it does not: its misfit is 0 or without bound.
LogEvidence coarse_evidence(const CoarseLog& log, const LogExplanation& explanation);

}  // namespace faultline
