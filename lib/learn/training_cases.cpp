// SPDX-License-Identifier: MIT
#include "lib/learn/training_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "lib/core/error.hpp"
#include "lib/diagnose/decide_episode.hpp"

namespace faultline {
namespace {

/// Trains two classifiers: number h without the cases i with i % 2 == h.
std::array<EpisodeClassifier, 2> trained_on_halves(const std::vector<Case>& cases,
                                                   const EpisodeClassifierOptions& options) {
  std::array<EpisodeClassifier, 2> half;
  for (std::size_t h = 0; h < half.size(); ++h) {
    std::vector<Case> others;
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (i % 2 != h) others.push_back(cases[i]);
    half[h] = trained_on(others, options);
  }
  return half;
}

Case case_of(const MonitoredRun& run, const Episode& episode) {
  Case c;
  c.episode = episode;
  c.decision = c.label = run.label;
  c.outcome = CaseOutcome::confirmed;
  c.origin = run.origin;
  if (run.origin == kSimulatedOrigin) return c;
  c.log_sha256 = run.log.log.sha256;
  c.log_name = std::filesystem::path(run.log.log.path).filename().string();
  c.onset_s = run.onset_s;
  return c;
}

/// Throws Error(input) unless each half of the cases has two labels, as every classifier needs.
void check_kinds(const std::vector<Case>& cases, std::size_t runs) {
  for (std::size_t half = 0; half < 2; ++half) {
    std::vector<FaultLabel> labels;
    for (std::size_t i = half; i < cases.size(); i += 2)
      if (std::find(labels.begin(), labels.end(), cases[i].label) == labels.end())
        labels.push_back(cases[i].label);
    if (labels.size() < 2)
      throw Error(
          ErrorCode::input, "the healthy logs",
          fmt::format("leave so much torque unexplained that faults cannot be distinguished: only {} "
                      "of {} simulated faults show in them. Look at the residual of each joint: "
                      "faultline identify LOG... --robot ROBOT.toml -o F --html F. If it is large in "
                      "every row, check units, signs and columns; if it is noise, record faster motions; "
                      "if it is large in some rows, the robot has what the model lacks, such as an "
                      "elastic joint",
                      cases.size(), runs));
  }
}

}  // namespace

std::vector<Case> training_cases(std::span<const MonitoredRun> runs, const Model& model) {
  std::vector<Case> cases;
  for (const MonitoredRun& run : runs)
    if (const MonitoredEpisode* of_fault = episode_of_fault(run))
      cases.push_back(case_of(run, describe_episode(*of_fault, model).episode));
  check_kinds(cases, runs.size());
  return cases;
}

EpisodeClassifier trained_on(const std::vector<Case>& cases, const EpisodeClassifierOptions& options) {
  std::vector<LabelledEpisode> episodes;
  for (const Case& c : cases) episodes.push_back({c.episode.features, c.label});
  return train_episode_classifier(episodes, options);
}

CaseBase fill_case_base(const std::vector<Case>& training, const Model& model,
                        const EpisodeClassifierOptions& options) {
  CaseBase cases(episode_feature_names(model.labels, model.robot.joints()));
  const std::array<EpisodeClassifier, 2> half = trained_on_halves(training, options);
  for (std::size_t i = 0; i < training.size(); ++i) {
    Case c = training[i];
    const Opinions opinions = classify_episode(half[i % 2], c.episode.features);
    c.episode.mlp = opinions.mlp;
    c.episode.rbfn = opinions.rbfn;
    cases.retain(std::move(c));
  }
  cases.learn();
  return cases;
}

}  // namespace faultline
