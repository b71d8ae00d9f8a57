// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/diagnose/decision.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/monitor/monitored_log.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Returns an episode in the terms of a decision, without votes, and without the opinions of networks that
/// are not trained.
DecisionBasis describe_episode(const MonitoredEpisode& observed, const Model& model);

/// Decides which fault an episode is: evidence by label -> features -> the opinions of MLP and RBFN -> votes
/// of similar cases -> the decision, from which the texts of the finding follow. If networks and votes decide
/// nothing, the label is that of the likeliest fault.
FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases);

/// Returns what the confidence of a decision on an episode comes from.
ConfidenceSource confidence_source(DecidedBy decided_by);

/// Returns the cases that a report shows beside an episode: those that voted, and near ones that were not
/// simulated; first those confirmed in the field, then labelled, diagnosed and simulated cases, of each
/// origin the most similar first. Each lists features that agree and features that differ.
std::vector<Precedent> precedents_of(const DecisionBasis& basis, const CaseBase& cases, const Model& model);

}  // namespace faultline
