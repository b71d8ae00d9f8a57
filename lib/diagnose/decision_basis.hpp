// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/votes.hpp"
#include "lib/classify/episode_features.hpp"

namespace faultline {

/// All that a decision on an episode is made from.
struct DecisionBasis {
  /// The fault that explains the log best; FaultKind::unknown where a change of any form explains much more.
  FaultLabel likeliest;
  std::vector<FaultLabel> as_likely;    ///< explain the log almost as well
  std::vector<LabelEvidence> evidence;  ///< of each label
  Episode episode;                      ///< features, and the opinions of both networks
  Votes votes;                          ///< of similar cases
  double limit = 0.0;                   ///< nats that the evidence had to pass
};

}  // namespace faultline
