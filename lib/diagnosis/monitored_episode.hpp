// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/episode_evidence.hpp"
#include "lib/residual/residual_summary.hpp"

namespace faultline {

/// A stretch of a log that the healthy robot does not explain, as monitoring leaves it: all that a decision
/// is made from.
struct MonitoredEpisode {
  EpisodeEvidence evidence;
  std::vector<JointResidual> residuals;  ///< of the MLP, a joint each, from onset to when it was named
};

}  // namespace faultline
