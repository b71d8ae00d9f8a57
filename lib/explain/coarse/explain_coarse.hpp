// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/coarse/coarse_log.hpp"
#include "lib/explain/explain.hpp"

namespace faultline {

/// What a log at a coarse rate says: the best hypothesis of each kind and joint, best first.
LogExplanation explain_coarse(const CoarseLog& log);

/// Evidence of `hypothesis` from its onset on.
EvidenceCourse coarse_course(const CoarseLog& log, const FaultHypothesis& hypothesis);

/// Whether a hypothesis leaves so much that the fault is none of the kinds: 0, or without bound.
double coarse_misfit(const LogExplanation& explanation, const FaultHypothesis& hypothesis);

}  // namespace faultline
