// SPDX-License-Identifier: MIT
#pragma once

#include <array>
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
  double threshold = 0.0;               ///< nats that raise an alarm (EvidenceOptions::threshold)
  /// By joint: it stands still though torque or weight acts on it, so it is not free.
  std::array<bool, kMaxJoints> is_held{};
};

}  // namespace faultline
