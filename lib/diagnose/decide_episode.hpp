// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/monitored_episode.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Decides which fault an episode is: evidence by label -> features -> the opinions of MLP and RBFN -> votes
/// of similar cases -> the decision, from which the texts of the finding follow. If networks and votes decide
/// nothing, the label is that of the likeliest fault.
FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases);

}  // namespace faultline
