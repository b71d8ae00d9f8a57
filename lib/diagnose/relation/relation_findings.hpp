// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/explain/signal_stretch.hpp"
#include "lib/model/model.hpp"
#include "lib/residual/relation/relation_watch.hpp"

namespace faultline {

/// How far beyond its limit an episode was.
std::vector<EvidenceItem> limit_evidence(const RelationEpisode& episode);
/// 0 to 1.
double confidence_of(const RelationEpisode& episode);

/// The episodes as one score takes them (judge_stretch()); without the jolt of another drive while the
/// controller answers to what one drive does. `torque`: that of the torque balance.
std::vector<SignalStretch> stretches_of(const std::vector<RelationEpisode>& episodes, TorqueMeaning torque);

/// An episode and the fault that explains it as a finding; it ends with the log at the latest.
FaultFinding finding_of(const RelationEpisode& episode, const ExplainedFault& fault, double log_end_s,
                        const Model& model);

}  // namespace faultline
