// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/case.hpp"
#include "lib/classify/episode_features.hpp"
#include "lib/diagnose/monitored_episode.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// An episode in the terms of a decision, before it is made.
struct DescribedEpisode {
  std::vector<LabelEvidence> evidence;  ///< of each label
  Episode episode;  ///< as the case base compares it; without opinions if the networks are not trained
};

DescribedEpisode describe_episode(const MonitoredEpisode& observed, const Model& model);

}  // namespace faultline
