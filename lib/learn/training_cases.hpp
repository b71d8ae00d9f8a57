// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/classify/episode_classifier.hpp"
#include "lib/learn/twin_study.hpp"

namespace faultline {

/// Returns the cases that the networks and the case base learn from: of each run the episode that belongs to
/// its fault, with label and origin of the run, without the opinions of the networks. Throws Error(input) if
/// they do not suffice to train both networks.
std::vector<Case> training_cases(std::span<const MonitoredRun> runs, const Model& model);

/// Trains both networks on the features and labels of the cases.
EpisodeClassifier trained_on(const std::vector<Case>& cases, const EpisodeClassifierOptions& options);

/// Returns the case base of these cases, each with its opinions. They come from networks that were trained on
/// the other half of the cases, so that they are as accurate as in use, not better.
CaseBase fill_case_base(const std::vector<Case>& training, const Model& model,
                        const EpisodeClassifierOptions& options);

}  // namespace faultline
