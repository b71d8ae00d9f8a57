// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/criterion_sweep.hpp"

#include <gtest/gtest.h>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

const OutputMeaning kMeaning{{{FaultKind::free_swinging, 1_joint}, {FaultKind::free_swinging, 2_joint}, {}},
                             Eigen::Vector3d(0.2, 0.3, 0.5)};

/// Outputs that lean to one class for a while, then to another; some missing.
Eigen::MatrixXd leaning_outputs(int samples) {
  Random random(5);
  Eigen::MatrixXd outputs(3, samples);
  int class_now = 2;
  for (int i = 0; i < samples; ++i) {
    if (random.uniform() < 0.05) class_now = static_cast<int>(random.below(3));
    for (int c = 0; c < 3; ++c) outputs(c, i) = random.uniform() + (c == class_now ? 0.5 : 0.0);
    if (random.uniform() < 0.01) outputs(0, i) = std::numeric_limits<double>::quiet_NaN();
  }
  return outputs;
}

std::vector<double> alarm_times(const CriterionOptions& options, const Eigen::VectorXd& time,
                                const Eigen::MatrixXd& outputs) {
  CriterionState state;
  std::vector<double> times;
  for (const SampleEpisode& episode : apply_criterion(options, kMeaning, time, outputs, state))
    times.push_back(episode.alarm_s);
  if (const auto open = open_episode(kMeaning, state)) times.push_back(open->alarm_s);
  return times;
}

std::vector<double> times_of(const Alarms& alarms) {
  std::vector<double> times;
  for (const Alarm& alarm : alarms) times.push_back(alarm.time_s);
  return times;
}

TEST(CriterionSweep, RaisesTheAlarmsOfApplyCriterionForEveryG) {
  const Eigen::MatrixXd outputs = leaning_outputs(5000);
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(5000, 0.0, 499.9);
  const std::vector<Alarms> swept = sweep_consecutive(kMeaning, time, outputs, 12);
  ASSERT_EQ(swept.size(), 12u);
  EXPECT_GT(swept[3].size(), 10u);
  for (int g = 1; g <= 12; ++g)
    EXPECT_EQ(times_of(swept[g - 1]),
              alarm_times({.kind = CriterionKind::consecutive, .g = g}, time, outputs))
        << g;
}

TEST(CriterionSweep, RaisesTheAlarmsOfApplyCriterionForEveryThreshold) {
  const Eigen::MatrixXd outputs = leaning_outputs(5000);
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(5000, 0.0, 499.9);
  const std::vector<double> thresholds = {0.7, 2.0, 5.0, 9.0};
  const std::vector<Alarms> swept = sweep_log_odds(kMeaning, time, outputs, thresholds, 3.0);
  EXPECT_GT(swept[1].size(), 10u);
  for (std::size_t i = 0; i < thresholds.size(); ++i)
    EXPECT_EQ(times_of(swept[i]),
              alarm_times({.kind = CriterionKind::log_odds, .threshold = thresholds[i], .sample_cap = 3.0},
                          time, outputs))
        << thresholds[i];
}

TEST(CriterionSweep, NamesAnAlarmByTheOutputThatRaisedIt) {
  Eigen::MatrixXd outputs(3, 3);
  outputs << 0.0, 0.0, 0.0, 0.1, 0.9, 0.9, 0.8, 0.1, 0.1;
  const Eigen::Vector3d time(0.0, 1.0, 2.0);
  const Alarms alarms = sweep_consecutive(kMeaning, time, outputs, 2)[1];
  ASSERT_EQ(alarms.size(), 1u);
  EXPECT_EQ(alarms[0].time_s, 2.0);
  EXPECT_EQ(alarms[0].label, kMeaning.classes[1]);
}

AlarmScore score(int found, int false_alarms) {
  AlarmScore score;
  for (int i = 0; i < 100; ++i) score.outcomes.push_back({.detected = i < found});
  score.false_alarms = false_alarms;
  return score;
}

TEST(ChooseSetting, ChoosesTheFirstWithTheFewestFalseAlarmsAndAStepOfMargin) {
  const std::vector<AlarmScore> scores = {score(100, 50), score(100, 3), score(99, 0), score(99, 0),
                                          score(70, 0)};
  EXPECT_EQ(choose_setting(scores), 3);
}

TEST(ChooseSetting, ChoosesNoMarginThatCostsDetectionsAndNoSettingThatFindsLittle) {
  const std::vector<AlarmScore> scores = {score(100, 50), score(95, 2), score(80, 0)};
  EXPECT_EQ(choose_setting(scores), 1);
}

}  // namespace
}  // namespace faultline
