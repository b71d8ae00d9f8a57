// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lib/core/parallel.hpp"
#include "lib/evidence/learn_motion_model.hpp"
#include "lib/evidence/slow_states.hpp"
#include "lib/evidence/watch/episode_detector.hpp"

namespace faultline {
namespace {

constexpr int kMostInflations = 3;       // beyond that the model is blind rather than calm
constexpr double kInflation = 1.5;       // of the process noise, a round
constexpr double kTriggerSpare = 1.15;   // over what healthy logs reach: other days are worse
constexpr double kThresholdSpare = 1.5;  // the same of the ratio, whose extremes scatter more
// What neither may be raised beyond.
constexpr double kHighestTrigger = 12.0;
constexpr double kHighestThreshold = 45.0;

/// The largest statistics that healthy logs reach.
struct Extremes {
  double trigger = 0.0;
  double ratio = 0.0;
};

Extremes extremes_of(LogSource& log, const MotionModel& model, const std::vector<Hypothesis>& hypotheses,
                     const EvidenceOptions& options) {
  EpisodeDetector detector(model, hypotheses, options, survey_noise(log, model));
  log.rewind();
  for (Log segment; log.next(segment);) detector.take(segment);
  detector.finish();
  Extremes seen{detector.largest_trigger(), detector.largest_ratio()};
  for (const EpisodeEvidence& episode : detector.episodes())
    seen.ratio = std::max(seen.ratio, episode.hypotheses[episode.best].log_likelihood_ratio);
  return seen;
}

Extremes extremes(std::span<LogSource* const> logs, const MotionModel& model,
                  const std::vector<Hypothesis>& hypotheses, const EvidenceOptions& options, int threads) {
  std::vector<Extremes> parts(logs.size());
  parallel_for(static_cast<int>(logs.size()), threads,
               [&](int i) { parts[i] = extremes_of(*logs[i], model, hypotheses, options); });
  Extremes seen;
  for (const Extremes& part : parts) {
    seen.trigger = std::max(seen.trigger, part.trigger);
    seen.ratio = std::max(seen.ratio, part.ratio);
  }
  return seen;
}

}  // namespace

EvidenceOptions calibrate_thresholds(std::span<LogSource* const> logs, MotionModel& model,
                                     const std::vector<Hypothesis>& hypotheses, const EvidenceOptions& start,
                                     int threads) {
  for (int round = 0;; ++round) {
    const Extremes seen = extremes(logs, model, hypotheses, start, threads);
    const double trigger = kTriggerSpare * seen.trigger, threshold = kThresholdSpare * seen.ratio;
    if (round == kMostInflations || (trigger <= kHighestTrigger && threshold <= kHighestThreshold)) {
      EvidenceOptions options = start;
      options.trigger = std::max(start.trigger, std::min(trigger, kHighestTrigger));
      options.threshold = std::max(start.threshold, std::min(threshold, kHighestThreshold));
      return options;
    }
    model.noise.torque_share *= kInflation;
    model.noise.rest_share *= kInflation;
    for (double& floor : model.noise.floor) floor *= kInflation;
    for (SlowState& slow : model.slow)
      if (slow.kind == SlowKind::coloured_torque) slow.day_std *= kInflation;
  }
}

}  // namespace faultline
