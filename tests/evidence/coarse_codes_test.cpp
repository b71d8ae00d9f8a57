// SPDX-License-Identifier: MIT
// Encoders of coarse codes on robots that rest, learned from logs in which nothing rests.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "lib/evidence/bank.hpp"
#include "lib/evidence/learn/learn_motion_model.hpp"
#include "lib/evidence/survey/survey_log.hpp"
#include "lib/evidence/watch/episode_detector.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr double kCode = 2e-4;  // rad

SimulationSpec coded(double duration_s, double rest_s) {
  SimulationSpec spec = rrp_run(duration_s);
  spec.sample_period_s = spec.control_period_s = 0.002;
  spec.noise.q = {1e-6, 1e-6, 1e-6};
  spec.noise.q_resolution = {kCode, kCode, kCode};
  spec.motion.dwell_min_s = spec.motion.dwell_max_s = rest_s;
  return spec;
}

MotionModel learned_from(std::vector<MemorySource> days, double dq_std) {
  std::vector<LogSource*> logs;
  for (MemorySource& day : days) logs.push_back(&day);
  IdentifiedMotion identified;
  identified.chain = known_rrp().chain;
  identified.torque_is_held = true;
  identified.q_std.assign(3, kCode / std::sqrt(12.0));
  identified.dq_std = {dq_std, dq_std, 0.2 * dq_std};
  return learn_motion_model(logs, identified, {});
}

const MotionModel& learned_in_motion() {
  static const MotionModel model = [] {
    std::vector<MemorySource> days;
    for (const std::uint64_t seed : {11, 12})
      days.emplace_back(simulate(known_rrp(), coded(8.0, 0.0), seed).log);
    return learned_from(std::move(days), 5e-3);
  }();
  return model;
}

/// Velocities as differences of the codes: at rest both repeat.
Log in_codes_alone(Log log) {
  for (std::size_t j = 0; j < log.q.size(); ++j)
    for (int k = log.rows() - 1; k > 0; --k)
      log.dq[j][k] = (log.q[j][k] - log.q[j][k - 1]) / (log.time[k] - log.time[k - 1]);
  return log;
}

std::vector<EpisodeEvidence> episodes_of(const Log& log, const MotionModel& model = learned_in_motion()) {
  const auto bank = hypotheses_of(model.joints(), TorqueMeaning::commanded);
  MemorySource source(log);
  EpisodeDetector detector(model, bank, {}, survey_noise(source, model));
  for (Log segment; source.next(segment);) detector.take(segment);
  detector.finish();
  return detector.episodes();
}

TEST(CoarseCodes, ARobotAtRestIsNoFault) {
  for (const std::uint64_t seed : {21, 22, 23})
    EXPECT_TRUE(episodes_of(simulate(known_rrp(), coded(12.0, 2.5), seed).log).empty()) << seed;
}

TEST(CoarseCodes, RestDoesNotMakeALogLookQuieter) {
  MemorySource source(simulate(known_rrp(), coded(12.0, 2.5), 21).log);
  const LogNoise noise = survey_noise(source, learned_in_motion());
  for (int j = 0; j < 3; ++j) EXPECT_GT(noise.q_scale[j], 0.8) << j;
}

TEST(CoarseCodes, AShiftedReadingOfARobotAtRestIsFoundAtOnce) {
  SimulationSpec spec = coded(12.0, 2.5);
  spec.faults = {{FaultKind::sensor_bias, 1, 2.6, 1e9, 0.02, 0.0}};  // it rests from 1.8 s at the latest
  const auto episodes = episodes_of(simulate(known_rrp(), spec, 21).log);
  ASSERT_FALSE(episodes.empty());
  EXPECT_NEAR(episodes.front().alarm_s, 2.6, 0.05);
}

/// A code that repeats is certain for both, and nothing is likelier than certain.
TEST(CoarseCodes, AJointThatRestsIsStuckAndLockedAlike) {
  std::vector<MemorySource> days;
  for (const std::uint64_t seed : {11, 12})
    days.emplace_back(in_codes_alone(simulate(known_rrp(), coded(8.0, 2.5), seed).log));
  const MotionModel model = learned_from(std::move(days), 0.1);
  const std::vector<Hypothesis> hypotheses = hypotheses_of(3, TorqueMeaning::commanded);
  Log log = in_codes_alone(simulate(known_rrp(), coded(8.0, 2.5), 21).log);
  constexpr int kRests = 1000, kRows = 200;  // it rests from 1.8 s at the latest
  for (int k = kRests; k < kRests + kRows; ++k) {
    log.q[0][k] = log.q[0][kRests - 1];
    log.dq[0][k] = log.dq[0][kRests - 1] = 0.0;
  }
  Follower follower(model);
  const Bank bank(model, follower.dynamics(), hypotheses);
  std::vector<FollowedSample> samples(log.rows());
  for (int k = 0; k < kRests + kRows; ++k) follower.follow(log, k, samples[k]);
  const auto ratio = [&](FaultKind kind) {
    const auto named = [&](const Hypothesis& h) { return h.label == FaultLabel{kind, 1}; };
    const auto found = std::find_if(hypotheses.begin(), hypotheses.end(), named);
    RunningHypothesis running = bank.start(static_cast<int>(found - hypotheses.begin()), kRests,
                                           samples[kRests - 1], samples[kRests]);
    for (int k = kRests + 1; k < kRests + kRows; ++k) bank.advance(running, samples[k - 1], samples[k]);
    return running.log_likelihood_ratio;
  };
  EXPECT_NEAR(ratio(FaultKind::stuck_encoder), ratio(FaultKind::locked), 8.0);
}

}  // namespace
}  // namespace faultline
