// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/model/model.hpp"
#include "lib/residual/relation/relation_watch.hpp"

namespace faultline {

/// How far beyond its limit an episode was.
std::vector<EvidenceItem> limit_evidence(const RelationEpisode& episode);
/// 0 to 1.
double confidence_of(const RelationEpisode& episode);

/// What a second residual found: a loss of torque where a share of the command is missing, else an unknown
/// fault of that joint's drive or control.
FaultFinding finding_of(const RelationEpisode& episode, const Chain& chain);

/// The findings of the motion together with those of second residuals: what the motion showed of the same
/// thing becomes evidence of one finding, and what follows from a fault is none: a control law that is
/// left for long after it, a jolt of another drive meanwhile.
std::vector<FaultFinding> with_relations(std::vector<FaultFinding> motion,
                                         const std::vector<RelationEpisode>& episodes, const Chain& chain);

}  // namespace faultline
