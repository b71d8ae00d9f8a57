// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/classify/episode_classifier.hpp"
#include "lib/learn/twin_study.hpp"

namespace faultline {

/// Where a case comes from.
struct CaseSource {
  std::string origin;
  std::string log_sha256;  ///< empty where it was no file
  std::string log_name;    ///< without folders; empty where it was no file
  double onset_s = std::numeric_limits<double>::quiet_NaN();
};

/// The episodes that the networks and the case base learn from: of each run the one that belongs to its
/// fault, with its label and where it comes from.
struct TrainingEpisodes {
  std::vector<LabelledEpisode> episodes;
  std::vector<double> evidence;     ///< log likelihood ratio of the best hypothesis, one an episode
  std::vector<CaseSource> sources;  ///< as a case tells it
};

TrainingEpisodes training_episodes(std::span<const MonitoredRun> runs, const Model& model);

/// A case an episode. The opinions kept with it come from networks that were trained on the other half of the
/// episodes, so that they are as good as they will be in use, not better.
CaseBase fill_case_base(const TrainingEpisodes& training, const Model& model,
                        const EpisodeClassifierOptions& options);

}  // namespace faultline
