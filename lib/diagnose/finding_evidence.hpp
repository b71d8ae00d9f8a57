// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/diagnose/decided_episode.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// What speaks for a decision: its reason in a sentence, what similar cases hold against it, the log
/// likelihood ratio, the size of the fault, and the MLP's residual of each joint.
std::vector<EvidenceItem> finding_evidence(const DecidedEpisode& decided, const Model& model);

}  // namespace faultline
