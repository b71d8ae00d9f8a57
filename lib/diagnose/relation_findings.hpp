// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/explain/signal_stretch.hpp"
#include "lib/model/model.hpp"
#include "lib/residual/relation/relation_detector.hpp"

namespace faultline {

/// Converts the episodes for the joint score with the torque balance (judge_stretch()), without the short
/// deviation of a drive while the controller reacts to another one. `torque`: that of the torque balance.
std::vector<SignalStretch> stretches_of(const std::vector<RelationEpisode>& episodes, TorqueMeaning torque);

/// Makes the finding of an episode and the fault that explains it; it ends with the log at the latest.
FaultFinding finding_of(const RelationEpisode& episode, const JudgedStretch& judged, double log_end_s,
                        const Model& model);

// Findings of a log without torque: how the joints follow their references.

/// Makes the findings of joints that do not follow: `locked` if the joint stands still while its reference
/// moves, else `unknown`. Episodes of position and velocity at the same time are one finding.
std::vector<FaultFinding> tracking_findings(const std::vector<RelationEpisode>& episodes, const Chain& chain);

/// Number of rows that were compared with a reference, for the relation that was judged for longest.
/// `judged_s`: by relation, s.
std::int64_t rows_tracked(const Model& model, const std::vector<double>& judged_s);

/// Returns the joints with tracking relations in the model, none of which was judged in the log.
std::vector<Joint> joints_not_tracked(const Model& model, const std::vector<double>& judged_s);

/// Lists what such a log cannot show, and the smallest tracking error that is detected, a sentence each.
std::vector<std::string> tracking_spots(const Model& model, const std::vector<double>& judged_s);

}  // namespace faultline
