// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/coarse/coarse_log.hpp"
#include "lib/explain/explain.hpp"

namespace faultline {

/// Explains a log at a coarse rate: the best hypothesis of each kind and joint, best first.
LogExplanation explain_coarse(const CoarseLog& log);

/// Follows a fault of an earlier part of the log that lasts when this one begins. Returns it with its new
/// size and its end, if the log shows one: its first sample if the evidence for it is at most `limit` (nats).
FaultClaim followed_coarse(const CoarseLog& log, FaultClaim lasting, double limit);

}  // namespace faultline
