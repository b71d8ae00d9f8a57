// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/explain/signal_stretch.hpp"
#include "lib/model/model.hpp"
#include "lib/residual/relation/relation_detector.hpp"

namespace faultline {

/// Returns the evidence of an episode: its largest mean over the limit, and the log likelihood ratio.
std::vector<EvidenceItem> limit_evidence(const RelationEpisode& episode);
/// Confidence in an episode, 0 to 1, by how far it exceeds its limit.
double confidence_of(const RelationEpisode& episode);

/// Converts the episodes for the joint score with the torque balance (judge_stretch()), without the short
/// deviation of a drive while the controller reacts to another one. `torque`: that of the torque balance.
std::vector<SignalStretch> stretches_of(const std::vector<RelationEpisode>& episodes, TorqueMeaning torque);

/// Makes the finding of an episode and the fault that explains it; it ends with the log at the latest.
FaultFinding finding_of(const RelationEpisode& episode, const JudgedStretch& judged, double log_end_s,
                        const Model& model);

}  // namespace faultline
