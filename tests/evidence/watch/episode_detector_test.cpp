// SPDX-License-Identifier: MIT
#include "lib/evidence/watch/episode_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "lib/classify/episode_features.hpp"
#include "lib/evidence/learn/learn_motion_model.hpp"
#include "lib/evidence/motion_model_json.hpp"
#include "lib/evidence/standstill.hpp"
#include "lib/fault/label_text.hpp"
#include "tests/support/rrp_runs.hpp"

namespace faultline {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kOnset_s = 2.503;

std::vector<EpisodeEvidence> detected(const Log& log, int segment_rows = 4096,
                                      const EvidenceOptions& options = {},
                                      const MotionModel& model = rrp_motion_model()) {
  const std::vector<Hypothesis> bank = hypotheses_of(model.joints(), TorqueMeaning::commanded);
  EpisodeDetector detector(model, bank, options);
  MemorySource source(log, "memory", segment_rows);
  for (Log segment; source.next(segment);) detector.take(segment);
  detector.finish();
  return detector.episodes();
}

FaultLabel named(const EpisodeEvidence& episode) {
  const MotionModel& model = rrp_motion_model();
  return likeliest(evidence_by_label(episode, hypotheses_of(model.joints(), TorqueMeaning::commanded), model))
      .label;
}

Log healthy_log(double duration_s = 10.0, std::uint64_t seed = 77) {
  return simulate(known_rrp(), rrp_run(duration_s), seed).log;
}

Log faulty_log(FaultKind kind, int joint, double size = 0.0, double length_s = 1e9) {
  return simulate(known_rrp(), rrp_run_with(kind, joint, kOnset_s, size, length_s), 5).log;
}

bool same(const EpisodeEvidence& a, const EpisodeEvidence& b) {
  bool equal = a.onset_s == b.onset_s && a.alarm_s == b.alarm_s && a.isolated_s == b.isolated_s &&
               a.end_s == b.end_s && a.samples == b.samples && a.best == b.best &&
               a.hypotheses.size() == b.hypotheses.size();
  for (std::size_t h = 0; equal && h < a.hypotheses.size(); ++h)
    equal = a.hypotheses[h].log_likelihood_ratio == b.hypotheses[h].log_likelihood_ratio &&
            a.hypotheses[h].size == b.hypotheses[h].size &&
            a.hypotheses[h].size_std == b.hypotheses[h].size_std &&
            a.hypotheses[h].impulse == b.hypotheses[h].impulse;
  return equal;
}

/// Whether any episode shows that something holds joint 1 while the torque may or may not have acted.
bool finds_it_held(const Log& log) {
  for (const EpisodeEvidence& episode : detected(log))
    if (is_held(episode.standstill[0], false)) return true;
  return false;
}

TEST(EpisodeDetector, AJointThatRunsIntoAStopIsHeldAndOneThatSwingsFreelyIsNot) {
  int held = 0, free = 0;
  for (const std::uint64_t seed : {5, 6, 7, 8}) {
    SimulationSpec spec = rrp_run(10.0);
    const Log before = simulate(known_rrp(), spec, seed).log;
    const auto [low, high] = std::minmax_element(before.q[0].begin(), before.q[0].end());
    spec.stops.low = {-1e3, -1e3, -1e3};
    spec.stops.high = {*low + 0.6 * (*high - *low), 1e3, 1e3};
    held += finds_it_held(simulate(known_rrp(), spec, seed).log);
    free +=
        finds_it_held(simulate(known_rrp(), rrp_run_with(FaultKind::free_swinging, 1, kOnset_s), seed).log);
  }
  EXPECT_GE(held, 3);
  EXPECT_EQ(free, 0);
}

TEST(EpisodeDetector, IsSilentOnHealthyRuns) {
  for (const std::uint64_t seed : {77, 78, 79})
    EXPECT_TRUE(detected(healthy_log(10.0, seed)).empty()) << seed;
}

TEST(EpisodeDetector, AStampBetweenTwoRowsIsReadByTheMotion) {
  MotionModel model = rrp_motion_model();
  model.steady_period_s = 0.01;
  for (const double off_s : {0.0049, 0.0051}) {
    Log log = healthy_log(10.0, 81);
    for (int k = 100; k < log.rows(); k += 50) log.time[k] += off_s;
    MemorySource source(log);
    EpisodeDetector detector(model, hypotheses_of(3, TorqueMeaning::commanded), {}, {});
    for (Log segment; source.next(segment);) detector.take(segment);
    detector.finish();
    EXPECT_TRUE(detector.episodes().empty()) << off_s;
  }
}

TEST(EpisodeDetector, ALogThatBeginsInTheMiddleOfAMoveIsSilent) {
  for (const bool with_speed : {true, false}) {
    Log log = healthy_log(20.0, 80);
    if (!with_speed) log.dq.clear();
    for (int begin = 50; begin + 300 < log.rows(); begin += 137)
      EXPECT_TRUE(detected(slice(log, begin, begin + 300)).empty())
          << begin << (with_speed ? "" : " without dq");
  }
}

TEST(EpisodeDetector, AFaultThatEndsWhileItIsTestedIsNamedWithItsEnd) {
  const double length_s = 0.25;  // a test takes longer
  const auto episodes = detected(faulty_log(FaultKind::stuck_encoder, 2, 0.0, length_s));
  ASSERT_EQ(episodes.size(), 1u);
  EXPECT_EQ(label_text(named(episodes[0])), label_text({FaultKind::stuck_encoder, 2}));
  EXPECT_NEAR(episodes[0].onset_s, kOnset_s, 0.05);
  EXPECT_NEAR(episodes[0].end_s, kOnset_s + length_s, 0.15);
}

/// A fault and how late its alarm may come.
struct Expected {
  FaultLabel label;
  double size;
  double length_s;
  double latest_s;
};

void PrintTo(const Expected& expected, std::ostream* out) { *out << label_text(expected.label); }

class EachFault : public testing::TestWithParam<Expected> {};

TEST_P(EachFault, IsNamedAtItsJointSoonAndNotEarly) {
  const Expected& expected = GetParam();
  const auto episodes =
      detected(faulty_log(expected.label.kind, expected.label.joint, expected.size, expected.length_s));
  ASSERT_FALSE(episodes.empty());
  const EpisodeEvidence& first = episodes.front();
  EXPECT_EQ(label_text(named(first)), label_text(expected.label));
  EXPECT_GE(first.alarm_s, kOnset_s);
  EXPECT_LE(first.alarm_s - kOnset_s, expected.latest_s);
  EXPECT_LE(first.onset_s, first.alarm_s);
  EXPECT_LE(first.alarm_s, first.isolated_s);
}

INSTANTIATE_TEST_SUITE_P(Rrp, EachFault,
                         testing::Values(Expected{{FaultKind::free_swinging, 1}, 0.0, 1e9, 0.09},
                                         Expected{{FaultKind::free_swinging, 3}, 0.0, 1e9, 0.05},
                                         Expected{{FaultKind::locked, 1}, 0.0, 1e9, 0.05},
                                         Expected{{FaultKind::locked, 2}, 0.0, 1e9, 0.05},
                                         Expected{{FaultKind::torque_loss, 3}, 0.5, 1e9, 0.1},
                                         Expected{{FaultKind::sensor_bias, 1}, 0.05, 1e9, 0.05},
                                         Expected{{FaultKind::stuck_encoder, 2}, 0.0, 1e9, 0.1},
                                         Expected{{FaultKind::sensor_drift, 2}, 0.1, 1e9, 0.3},
                                         Expected{{FaultKind::friction_increase, 1}, 3.0, 1e9, 0.5},
                                         Expected{{FaultKind::payload_change, 3}, 1.5, 1e9, 0.3},
                                         Expected{{FaultKind::collision, 1}, 40.0, 0.1, 0.05}));

TEST(EpisodeDetector, SegmentBordersChangeNothing) {
  const Log log = faulty_log(FaultKind::torque_loss, 3, 0.5);
  const auto whole = detected(log, 1 << 20);
  ASSERT_FALSE(whole.empty());
  for (const int rows : {1, 7, 100, 4096}) {
    const auto cut = detected(log, rows);
    ASSERT_EQ(cut.size(), whole.size()) << rows;
    for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_TRUE(same(cut[i], whole[i])) << rows;
  }
}

TEST(EpisodeDetector, AFewMissingPositionsAreNoFault) {
  Log log = healthy_log();
  for (int k = 500; k < 505; ++k) log.q[1][k] = kNaN;
  for (int k = 700; k < 705; ++k) log.dq[0][k] = kNaN;
  EXPECT_TRUE(detected(log).empty());
}

TEST(EpisodeDetector, ALogThatBeginsWithMissingValuesIsFollowedAllTheSame) {
  Log log = healthy_log();
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 3; ++j) log.q[j][k] = log.dq[j][k] = kNaN;
  EXPECT_TRUE(detected(log).empty());
}

TEST(EpisodeDetector, AWildValueInOneRowIsNoFault) {
  for (const double off : {0.05, -3.0, 1000.0}) {
    Log log = healthy_log();
    log.q[0][400] += off;
    EXPECT_TRUE(detected(log).empty()) << "position off by " << off;
  }
  for (const double off : {1.0, -50.0}) {
    Log log = healthy_log();
    log.dq[1][600] += off;
    EXPECT_TRUE(detected(log).empty()) << "velocity off by " << off;
  }
}

TEST(EpisodeDetector, MissingTorquesAreNoFault) {
  Log log = healthy_log();
  log.tau[0][300] = kNaN;
  for (int k = 700; k < 720; ++k) log.tau[2][k] = kNaN;
  EXPECT_TRUE(detected(log).empty());
}

TEST(EpisodeDetector, NothingButMissingValuesIsNoFault) {
  Log log = healthy_log(3.0);
  for (JointSignals* signals : {&log.q, &log.dq, &log.tau})
    for (auto& values : *signals) std::fill(values.begin(), values.end(), kNaN);
  EXPECT_TRUE(detected(log).empty());
}

TEST(EpisodeDetector, AGapInTimeStartsTheFilterAnew) {
  Log log = healthy_log(), later = healthy_log(10.0, 78);
  for (double& t : later.time) t += log.time.back() + 60.0;
  append(log, later);
  EXPECT_TRUE(detected(log).empty()) << "the robot was somewhere else after the gap";
  Log no_gap = log;
  for (int k = 0; k < no_gap.rows(); ++k) no_gap.time[k] = 0.01 * k;
  EXPECT_FALSE(detected(no_gap).empty())
      << "without the gap the same jump of all joints is no healthy motion";
}

TEST(EpisodeDetector, AFaultAcrossAGapIsJudgedWithWhatThereIs) {
  Log log = faulty_log(FaultKind::free_swinging, 3);
  const auto row = static_cast<int>(kOnset_s / 0.01) + 12;
  ASSERT_GT(log.rows(), row + 2);
  for (int k = row; k < log.rows(); ++k) log.time[k] += 5.0;
  const auto episodes = detected(log);
  ASSERT_FALSE(episodes.empty());
  EXPECT_LT(episodes.front().isolated_s, log.time[row]);
}

TEST(EpisodeDetector, AFaultIsJudgedByWhatCameBeforeTheRobotRanAway) {
  Log log = faulty_log(FaultKind::free_swinging, 2);
  for (int k = 0; k < log.rows(); ++k)
    if (log.time[k] > kOnset_s + 0.3) log.dq[0][k] = k % 2 ? 1e200 : -1e200;
  const auto episodes = detected(log);
  ASSERT_FALSE(episodes.empty());
  EXPECT_EQ(label_text(named(episodes.front())), "free_swinging 2");
  EXPECT_GE(episodes.front().alarm_s, kOnset_s);
  EXPECT_LT(episodes.front().isolated_s, kOnset_s + 0.31);
}

TEST(EpisodeDetector, WithoutVelocitiesFaultsAreFoundLater) {
  Log log = healthy_log();
  log.dq.clear();
  EXPECT_TRUE(detected(log).empty());
  log = faulty_log(FaultKind::free_swinging, 3);
  log.dq.clear();
  const auto episodes = detected(log);
  ASSERT_FALSE(episodes.empty());
  EXPECT_EQ(label_text(named(episodes.front())), "free_swinging 3");
}

TEST(EpisodeDetector, AJointHeldByAnEndStopIsNoFaultOfItsOwn) {
  SimulationSpec spec = rrp_run_with(FaultKind::free_swinging, 3, kOnset_s);
  spec.stops.low = {-3.0, -3.0, -0.42};
  spec.stops.high = {3.0, 3.0, 0.12};
  spec.duration_s = 8.0;
  const auto episodes = detected(simulate(known_rrp(), spec, 5).log);
  ASSERT_FALSE(episodes.empty());
  EXPECT_EQ(label_text(named(episodes.front())), "free_swinging 3");
  for (const EpisodeEvidence& episode : episodes) EXPECT_EQ(named(episode).joint, 3);
}

TEST(EpisodeDetector, ALogWithoutNoiseIsFollowed) {
  SimulationSpec spec = rrp_run(8.0);
  spec.noise = {};
  EXPECT_TRUE(detected(simulate(known_rrp(), spec, 4).log).empty());
}

TEST(EpisodeDetector, LogsOfNoneAndOneRowGiveNothing) {
  const Log log = healthy_log(1.0);
  EXPECT_TRUE(detected(slice(log, 0, 1)).empty());
  EXPECT_TRUE(detected(slice(log, 0, 0)).empty());
}

TEST(CalibrateThresholds, KeepsHealthyLogsCalmWhenTheMassesAreOnePercentWrong) {
  MotionModel model = rrp_motion_model(1.01);
  const auto owners = healthy_rrp_logs();
  std::vector<LogSource*> logs;
  for (const auto& log : owners) logs.push_back(log.get());
  const auto bank = hypotheses_of(3, TorqueMeaning::commanded);
  const EvidenceOptions options = calibrate_thresholds(logs, model, bank, {}).options;
  for (const auto& log : owners) EXPECT_TRUE(detected(log->log(), 4096, options, model).empty());
  EXPECT_TRUE(detected(healthy_log(), 4096, options, model).empty()) << "nor in a run it did not see";
  EXPECT_FALSE(detected(faulty_log(FaultKind::free_swinging, 3), 4096, options, model).empty());
}

TEST(CalibrateThresholds, OnlyFaultsThatHealthyLogsImitateAreMadeHarderToFind) {
  MotionModel model = rrp_motion_model(1.01);
  const ProcessNoise before = model.noise;
  const auto owners = healthy_rrp_logs();
  std::vector<LogSource*> logs;
  for (const auto& log : owners) logs.push_back(log.get());
  const auto bank = hypotheses_of(3, TorqueMeaning::commanded);
  const EvidenceOptions options = calibrate_thresholds(logs, model, bank, {}).options;
  EXPECT_EQ(options.threshold, EvidenceOptions{}.threshold);
  EXPECT_EQ(model.noise.torque_share, before.torque_share) << "the filter is not made blind";
  EXPECT_LT(options.imitations.size(), labels_of(bank).labels.size());
  nlohmann::json json;
  to_json(json, options);
  const EvidenceOptions read = evidence_options_from_json(json, "test");
  ASSERT_EQ(read.imitations.size(), options.imitations.size());
  for (const Imitation& imitation : options.imitations) {
    EXPECT_GT(imitation.nats, 0.0);
    EXPECT_EQ(read.imitation_of(imitation.label), imitation.nats);
  }
}

TEST(LearnMotionModel, RefusesAHandfulOfRows) {
  MemorySource tiny(healthy_log(0.2));
  std::vector<LogSource*> logs = {&tiny};
  IdentifiedMotion identified;
  identified.chain = known_rrp().chain;
  identified.q_std = identified.dq_std = {1e-3, 1e-3, 1e-3};
  EXPECT_THROW(learn_motion_model(logs, identified, {}), std::runtime_error);
}

}  // namespace
}  // namespace faultline
