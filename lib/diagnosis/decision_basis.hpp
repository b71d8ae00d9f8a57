// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/votes.hpp"
#include "lib/classify/episode_features.hpp"

namespace faultline {

/// All that a decision on an episode is made from.
struct DecisionBasis {
  std::vector<LabelEvidence> evidence;  ///< of each label; empty where no hypotheses were run
  Episode episode;                      ///< features, and the opinions of both networks
  Votes votes;                          ///< of similar cases
  Surprise usual{};                     ///< what the robot before the fault left unexplained
  double lasts_s = 0.0;                 ///< from onset to end
};

}  // namespace faultline
