// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/votes.hpp"
#include "lib/classify/episode_features.hpp"

namespace faultline {

/// The input of a decision on an episode.
struct DecisionBasis {
  /// The fault that explains the log best; FaultKind::unknown if the free form explains it much better.
  FaultLabel likeliest;
  std::vector<FaultLabel> as_likely;    ///< explain the log almost as well
  std::vector<LabelEvidence> evidence;  ///< of each label
  Episode episode;                      ///< features, and the opinions of both networks
  Votes votes;                          ///< of similar cases
  double limit = 0.0;                   ///< limit of the evidence, nats
};

}  // namespace faultline
