// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/classify/episode_classifier.hpp"
#include "lib/learn/twin_study.hpp"

namespace faultline {

/// The episodes that the networks and the case base learn from: of each run the one that belongs to its
/// fault, with its label and origin.
struct TrainingEpisodes {
  std::vector<LabelledEpisode> episodes;
  std::vector<Case> cases;  ///< one an episode, without the opinions of the networks
};

TrainingEpisodes training_episodes(std::span<const MonitoredRun> runs, const Model& model);

/// Gives the case of each episode its opinions. They come from networks that were trained on the other half
/// of the episodes, so that they are as accurate as in use, not better.
CaseBase fill_case_base(const TrainingEpisodes& training, const Model& model,
                        const EpisodeClassifierOptions& options);

}  // namespace faultline
