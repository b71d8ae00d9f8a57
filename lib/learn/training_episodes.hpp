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

/// The origin of a case.
struct CaseSource {
  std::string origin;
  std::string log_sha256;  ///< empty without a file
  std::string log_name;    ///< without folders; empty without a file
  double onset_s = std::numeric_limits<double>::quiet_NaN();
};

/// The episodes that the networks and the case base learn from: of each run the one that belongs to its
/// fault, with its label and origin.
struct TrainingEpisodes {
  std::vector<LabelledEpisode> episodes;
  std::vector<double> evidence;     ///< log likelihood ratio of the best hypothesis, one an episode
  std::vector<CaseSource> sources;  ///< as a case stores them
};

TrainingEpisodes training_episodes(std::span<const MonitoredRun> runs, const Model& model);

/// Makes a case of each episode. Its opinions come from networks that were trained on the other half of the
/// episodes, so that they are as accurate as in use, not better.
CaseBase fill_case_base(const TrainingEpisodes& training, const Model& model,
                        const EpisodeClassifierOptions& options);

}  // namespace faultline
