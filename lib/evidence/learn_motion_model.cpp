// SPDX-License-Identifier: MIT
#include "lib/evidence/learn_motion_model.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/evidence/episode_detector.hpp"
#include "lib/evidence/filter/follower.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr int kFewestRows = 50;       // fewer say nothing of noise and range
constexpr int kSettlingRows = 10;     // at the start of a log, which the filter needs to forget its guess
constexpr int kSearchRounds = 6;      // the first by this factor, each further one by its square root,
constexpr double kFirstFactor = 4.0;  // but by no less than the last: likelihood is flat within it
constexpr double kLastFactor = 1.2;
constexpr double kGain = 1e-9;  // of the likelihood: less is rounding
constexpr int kMostInflations = 8;
constexpr double kInflation = 1.5;       // of the process noise, a round
constexpr double kCalmShare = 0.6;       // of the threshold that healthy logs may reach: other days are worse
constexpr double kTriggerSpare = 1.1;    // over what healthy logs reach, where more noise does not help
constexpr double kThresholdSpare = 1.5;  // the same of the ratio, whose extremes scatter more
constexpr double kFloorShare = 0.001;    // of the largest torque, where matching starts
constexpr double kLeastFloor = 1e-9;     // N m or N, of joints without torque

/// M_jj in the middle of the range.
std::vector<double> inertia_scale(const MotionModel& model) {
  JointVector<double> middle(model.joints());
  for (int j = 0; j < model.joints(); ++j) middle[j] = 0.5 * (model.q_low[j] + model.q_high[j]);
  const JointMatrix<double> inertia = inertia_matrix(model.chain, middle);
  std::vector<double> diagonal;
  for (int j = 0; j < model.joints(); ++j) diagonal.push_back(inertia(j, j));
  return diagonal;
}

/// The same number of rows from the beginning of every log.
std::vector<Log> excerpts(std::span<LogSource* const> logs, int rows) {
  std::vector<Log> out;
  const int each = std::max(rows / static_cast<int>(std::max<std::size_t>(logs.size(), 1)), kFewestRows);
  for (LogSource* log : logs) {
    log->rewind();
    Log taken;
    for (Log segment; taken.rows() < each && log->next(segment);)
      append(taken, slice(segment, 0, std::min(segment.rows(), each - taken.rows())));
    if (taken.rows() > 1) out.push_back(std::move(taken));
  }
  return out;
}

double log_likelihood(const std::vector<Log>& logs, const MotionModel& model) {
  double sum = 0.0;
  FollowedSample sample;
  for (const Log& log : logs) {
    Follower follower(model);
    for (int k = 0; k < log.rows(); ++k) {
      follower.follow(log, k, sample);
      if (k > kSettlingRows) sum += sample.total_log_likelihood;
    }
  }
  return sum;
}

/// The numbers that the search moves, by factors.
std::vector<std::vector<double*>> free_numbers(MotionModel& model, bool held) {
  auto all = [](std::vector<double>& values) {
    std::vector<double*> pointers;
    for (double& value : values) pointers.push_back(&value);
    return pointers;
  };
  std::vector<std::vector<double*>> groups = {{&model.noise.torque_share},
                                              all(model.noise.floor),
                                              {&model.noise.rest_share},
                                              all(model.q_std),
                                              all(model.dq_std)};
  if (!held) groups.push_back({&model.noise.step_share});
  return groups;
}

/// Coordinate search by shrinking factors for the largest likelihood of the healthy innovations.
void match_noise(MotionModel& model, const std::vector<Log>& logs, bool held) {
  const auto groups = free_numbers(model, held);
  double best = log_likelihood(logs, model), factor = kFirstFactor;
  auto scale = [](const std::vector<double*>& group, double by) {
    for (double* value : group) *value *= by;
  };
  for (int round = 0; round < kSearchRounds; ++round, factor = std::sqrt(factor)) {
    for (const auto& group : groups) {
      for (const double by : {factor, 1.0 / factor}) {
        scale(group, by);
        const double moved = log_likelihood(logs, model);
        if (moved > best + kGain * std::abs(best)) {
          best = moved;
          break;
        }
        scale(group, 1.0 / by);
      }
    }
    factor = std::max(factor, kLastFactor);
  }
}

/// The largest statistics that healthy logs reach.
struct Extremes {
  double trigger = 0.0;
  double ratio = 0.0;
};

Extremes extremes(std::span<LogSource* const> logs, const MotionModel& model,
                  const std::vector<Hypothesis>& hypotheses, const EvidenceOptions& options) {
  Extremes seen;
  for (LogSource* log : logs) {
    log->rewind();
    EpisodeDetector detector(model, hypotheses, options);
    for (Log segment; log->next(segment);) detector.take(segment);
    detector.finish();
    seen.trigger = std::max(seen.trigger, detector.largest_trigger());
    seen.ratio = std::max(seen.ratio, detector.largest_ratio());
    for (const EpisodeEvidence& episode : detector.episodes())
      seen.ratio = std::max(seen.ratio, episode.hypotheses[episode.best].log_likelihood_ratio);
  }
  return seen;
}

}  // namespace

MotionModel learn_motion_model(std::span<LogSource* const> logs, const IdentifiedMotion& identified,
                               const LearnMotionOptions& options) {
  MotionModel model;
  model.chain = identified.chain;
  model.torque_phi = identified.torque_phi;
  model.q_std = identified.q_std;
  model.dq_std = identified.dq_std;
  const HealthyStatistics healthy = healthy_statistics(logs, identified.chain.joints());
  if (healthy.rows < kFewestRows)
    throw Error(ErrorCode::input, "healthy logs",
                "hold " + std::to_string(healthy.rows) + " usable rows; at least " +
                    std::to_string(kFewestRows) + " are needed");
  model.q_low = healthy.q_low;
  model.q_high = healthy.q_high;
  model.velocity_scale = healthy.velocity_rms;
  model.torque_scale = healthy.torque_largest;
  model.repeat_share = healthy.repeat_share;
  model.longest_repeat = healthy.longest_repeat;
  for (const double torque : healthy.torque_largest)
    model.noise.floor.push_back(std::max(kFloorShare * torque, kLeastFloor));
  if (identified.torque_is_held) model.noise.step_share = 0.0;
  model.inertia_scale = inertia_scale(model);
  model.priors = size_priors(model, healthy, options.priors);
  match_noise(model, excerpts(logs, options.excerpt_rows), identified.torque_is_held);
  ProcessNoise& noise = model.noise;
  noise.torque_share = std::max(options.safety * noise.torque_share, options.least_torque_share);
  noise.rest_share = std::max(options.safety * noise.rest_share, options.least_rest_share);
  noise.step_share *= options.safety;
  for (double& floor : noise.floor) floor *= options.safety;
  return model;
}

EvidenceOptions calibrate_thresholds(std::span<LogSource* const> logs, MotionModel& model,
                                     const std::vector<Hypothesis>& hypotheses, EvidenceOptions options) {
  for (int round = 0; round < kMostInflations; ++round) {
    const Extremes seen = extremes(logs, model, hypotheses, options);
    if (seen.trigger < options.trigger && seen.ratio < kCalmShare * options.threshold) return options;
    model.noise.torque_share *= kInflation;
    model.noise.rest_share *= kInflation;
    for (double& floor : model.noise.floor) floor *= kInflation;
  }
  const Extremes seen = extremes(logs, model, hypotheses, options);
  options.trigger = std::max(options.trigger, kTriggerSpare * seen.trigger);
  options.threshold = std::max(options.threshold, kThresholdSpare * seen.ratio);
  return options;
}

}  // namespace faultline
