// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"
#include "lib/classify/episode_features.hpp"
#include "lib/diagnosis/diagnosis.hpp"
#include "lib/diagnosis/monitored_episode.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Names what an episode is: evidence by label -> features -> the opinions of MLP and RBFN -> votes of
/// similar cases -> the decision, and only then all that is said about it.
FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases);

/// The episode as the case base compares it; opinions are those of the model's networks, none while they are
/// not trained.
Episode episode_of(const MonitoredEpisode& observed, const std::vector<LabelEvidence>& evidence,
                   const Model& model);

}  // namespace faultline
