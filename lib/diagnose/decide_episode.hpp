// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/monitored_episode.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Names what an episode is: evidence by label -> features -> the opinions of MLP and RBFN -> votes of
/// similar cases -> the decision, and only then all that is said about it. Its label is FaultKind::none where
/// nothing was found that stands up to its own likelihood.
FaultFinding decide_episode(const MonitoredEpisode& observed, const Model& model, const CaseBase& cases);

}  // namespace faultline
