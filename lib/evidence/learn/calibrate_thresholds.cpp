// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "lib/core/parallel.hpp"
#include "lib/evidence/learn/learn_motion_model.hpp"
#include "lib/evidence/survey/survey_log.hpp"
#include "lib/evidence/watch/episode_detector.hpp"

namespace faultline {
namespace {

constexpr double kTriggerSpare = 1.15;  // over what healthy logs reach: other days are worse
// The same of a ratio, whose extremes scatter more: of the fault itself, its kind at another joint, any
// fault.
constexpr double kOwnSpare = 1.5, kKindSpare = 1.0, kAnySpare = 0.5;
constexpr double kHighestTrigger = 12.0;
// Beyond, the process noise does not cover what the model misses: it is made larger, a few times at most.
constexpr double kMostImitated = 200.0;  // nats
constexpr int kMostInflations = 3;
constexpr double kInflation = 1.5;  // a round

HealthyExtremes extremes_of(LogSource& log, const MotionModel& model,
                            const std::vector<Hypothesis>& hypotheses, const EvidenceOptions& options) {
  EpisodeDetector detector(model, hypotheses, options, survey_noise(log, model));
  log.rewind();
  for (Log segment; log.next(segment);) detector.take(segment);
  detector.finish();
  return {detector.largest_trigger(), detector.largest_ratios()};
}

std::vector<HealthyExtremes> measure(std::span<LogSource* const> logs, const MotionModel& model,
                                     const std::vector<Hypothesis>& hypotheses, EvidenceOptions options,
                                     int threads) {
  options.only_measure = true;
  std::vector<HealthyExtremes> parts(logs.size());
  parallel_for(static_cast<int>(logs.size()), threads,
               [&](int i) { parts[i] = extremes_of(*logs[i], model, hypotheses, options); });
  return parts;
}

void raise(const std::vector<HealthyExtremes>& parts, HealthyExtremes& seen) {
  for (const HealthyExtremes& part : parts) {
    seen.trigger = std::max(seen.trigger, part.trigger);
    for (std::size_t h = 0; h < part.ratio.size(); ++h)
      seen.ratio[h] = std::max(seen.ratio[h], part.ratio[h]);
  }
}

/// What a fault may explain of a healthy log: more than it explained of those seen; a few logs do not show
/// all that a model error can look like, so what other faults explained counts too.
double allowance(const HealthyExtremes& seen, const std::vector<Hypothesis>& hypotheses,
                 const FaultLabel& label) {
  double nats = 0.0;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    if (hypotheses[h].label.kind == FaultKind::none) continue;
    const bool kind = hypotheses[h].label.kind == label.kind;
    const double spare = hypotheses[h].label == label ? kOwnSpare : kind ? kKindSpare : kAnySpare;
    nats = std::max(nats, spare * seen.ratio[h]);
  }
  return nats;
}

std::vector<Imitation> imitations(const HealthyExtremes& seen, const std::vector<Hypothesis>& hypotheses,
                                  double threshold) {
  std::vector<Imitation> out;
  for (const FaultLabel& label : labels_of(hypotheses).labels)
    if (const double nats = allowance(seen, hypotheses, label) - threshold;
        label.kind != FaultKind::none && nats > 0.0)
      out.push_back({label, std::min(nats, kMostImitated)});
  return out;
}

/// A filter that trusts its own motion less explains more, but lets faults explain what it leaves.
void inflate(MotionModel& model) {
  model.noise.torque_share *= kInflation;
  model.noise.rest_share *= kInflation;
  for (double& floor : model.noise.floor) floor *= kInflation;
  for (SlowState& slow : model.slow)
    if (slow.kind == SlowKind::coloured_torque) slow.day_std *= kInflation;
}

}  // namespace

double HealthyExtremes::largest_ratio() const {
  return ratio.empty() ? 0.0 : *std::max_element(ratio.begin(), ratio.end());
}

CalibratedThresholds calibrate_thresholds(std::span<LogSource* const> logs, MotionModel& model,
                                          const std::vector<Hypothesis>& hypotheses,
                                          const EvidenceOptions& start, int threads) {
  MotionModel tried = model;
  CalibratedThresholds out;
  HealthyExtremes seen;
  for (int round = 0; round <= kMostInflations; ++round) {
    if (round > 0) inflate(tried);
    HealthyExtremes now{0.0, std::vector<double>(hypotheses.size(), 0.0)};
    std::vector<HealthyExtremes> parts = measure(logs, tried, hypotheses, start, threads);
    raise(parts, now);
    if (round == 0) out.logs = std::move(parts);
    if (round == 0 || now.largest_ratio() < seen.largest_ratio()) {
      seen = now;
      model = tried;
    }
    if (kOwnSpare * seen.largest_ratio() <= kMostImitated) break;
  }
  EvidenceOptions& options = out.options = start;
  options.trigger = std::max(start.trigger, std::min(kTriggerSpare * seen.trigger, kHighestTrigger));
  options.imitations = imitations(seen, hypotheses, start.threshold);
  // woken later, tests see something else
  raise(measure(logs, model, hypotheses, options, threads), seen);
  options.imitations = imitations(seen, hypotheses, start.threshold);
  return out;
}

}  // namespace faultline
