// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/cases/case_base.hpp"
#include "lib/diagnosis/diagnosis.hpp"
#include "lib/evidence/episode_evidence.hpp"
#include "lib/model/model.hpp"
#include "lib/residual/residual_summary.hpp"

namespace faultline {

/// Names what an episode is: evidence by label -> features -> the opinions of MLP and RBFN -> case-based
/// decision, with what it could also be and the numbers that speak for it.
FaultFinding decide_episode(const EpisodeEvidence& episode, std::span<const JointResidual> residuals,
                            const Model& model, const CaseBase& cases);

/// The episode as the case base compares it; opinions are those of the model's judges.
Episode episode_of(const EpisodeEvidence& episode, std::span<const JointResidual> residuals,
                   const Model& model);

}  // namespace faultline
