// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/case.hpp"
#include "lib/cases/case_base.hpp"
#include "lib/classify/episode_features.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/monitor/monitored_log.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// An episode in the terms of a decision, before it is made.
struct DescribedEpisode {
  std::vector<LabelEvidence> evidence;  ///< of each label
  Episode episode;  ///< as the case base compares it; without opinions if the networks are not trained
};

DescribedEpisode describe_episode(const MonitoredEpisode& observed, const Model& model);

/// Decides which fault an episode is: evidence by label -> features -> the opinions of MLP and RBFN -> votes
/// of similar cases -> the decision, from which the texts of the finding follow. If networks and votes decide
/// nothing, the label is that of the likeliest fault.
FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases);

/// Returns what the confidence of a decision on an episode comes from.
ConfidenceSource confidence_source(DecidedBy decided_by);

}  // namespace faultline
