// SPDX-License-Identifier: MIT
// Faults in logs of 20 rows a second of a robot in closed form whose friction differs by day. The torque is
// held between samples, so that a fault that begins with a sample can be written into a healthy log.
#include "lib/explain/coarse/explain_coarse.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "lib/explain/explain_log.hpp"
#include "lib/identify/days/fit_coarse_days.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/identify/closed_form_scara.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.05;
constexpr std::size_t kFaulty = 120;  // first sample of a fault
constexpr double kOnset_s = kFaulty * kPeriod_s;

Log day_log(double friction, std::uint64_t seed, double kg_on_link_2 = 0.0) {
  testing::ClosedFormScara robot;
  for (int j = 0; j < 3; ++j) robot.fc[j] *= friction, robot.fv[j] *= friction;
  return testing::simulate_closed_form(robot, {.duration_s = 12.0,
                                               .period_s = kPeriod_s,
                                               .reach = {0.6, 0.7, 0.08},
                                               .q_noise = 1e-4,
                                               .dq_noise = 2e-3,
                                               .loaded_from_s = kOnset_s,
                                               .load_kg = kg_on_link_2,
                                               .seed = seed,
                                               .bandwidth = 2.5});
}

const ExplainModel& learned() {
  static const ExplainModel model = [] {
    std::vector<MemorySource> sources;
    std::vector<LogSource*> logs;
    for (const double friction : {0.95, 1.05, 1.0, 0.97})
      sources.emplace_back(day_log(friction, sources.size() + 1), "day");
    for (MemorySource& source : sources) logs.push_back(&source);
    const Robot robot = robot_from_toml("axes = \"RRP\"\n[known]\nl1 = 1.0\nl2 = 0.8\n", "robot");
    return ExplainModel{fit_coarse_days(logs, robot, parameter_space(robot), TorqueTiming::held),
                        evidence_limits({})};
  }();
  return model;
}

std::vector<ExplainedFault> faults_in(Log log) {
  MemorySource source(std::move(log), "log");
  return explain_whole_log(uniform_log(source, kPeriod_s), learned()).faults;
}

/// What is said of a day that was not learned from, after `change`.
std::vector<ExplainedFault> faults_of(const std::function<void(Log&)>& change) {
  Log log = day_log(1.03, 9);
  change(log);
  return faults_in(std::move(log));
}

TEST(ExplainCoarse, AHealthyDayHasNoFault) {
  EXPECT_TRUE(faults_of([](Log&) {}).empty());
}

TEST(ExplainCoarse, TheScoreOfAHealthyDayIsBelowOneAndThatOfALostTorqueAbove) {
  const auto score = [](double share) {
    Log log = day_log(1.03, 9);
    for (std::size_t k = kFaulty; k < log.time.size(); ++k) log.tau[1][k] /= 1.0 - share;
    MemorySource source(std::move(log), "log");
    return explain_whole_log(uniform_log(source, kPeriod_s), learned()).score;
  };
  EXPECT_TRUE(score(0.0).is_known());
  EXPECT_LT(score(0.0).ratio(), 1.0);
  EXPECT_GT(score(0.3).ratio(), 1.0);
  EXPECT_GT(score(0.6).ratio(), score(0.3).ratio());
}

TEST(ExplainCoarse, AStuckEncoderBeginsBetweenItsLastTrueAndItsFirstFalseCode) {
  for (const int j : {0, 1, 2}) {
    const auto faults = faults_of([&](Log& log) {
      for (std::size_t k = kFaulty; k < log.time.size(); ++k) {
        log.q[j][k] = log.q[j][kFaulty - 1];
        log.dq[j][k] = log.dq[j][kFaulty - 1];
      }
    });
    ASSERT_EQ(faults.size(), 1u) << j;
    EXPECT_EQ(faults[0].claim.kind, FaultKind::stuck_encoder) << j;
    EXPECT_EQ(faults[0].claim.joint, Joint::at(j));
    EXPECT_GT(faults[0].claim.onset_s, kOnset_s - kPeriod_s) << j;
    EXPECT_LE(faults[0].claim.onset_s, kOnset_s) << j;
    EXPECT_GE(faults[0].alarm_s, kOnset_s) << j;
  }
}

TEST(ExplainCoarse, APushIsFoundWithItsOnsetItsEndAndItsForce) {
  const auto faults = faults_of([](Log& log) {
    for (std::size_t k = kFaulty; k < kFaulty + 5; ++k) log.tau[1][k] -= 6.0;
  });
  ASSERT_EQ(faults.size(), 1u);
  const FaultClaim& push = faults[0].claim;
  EXPECT_EQ(push.kind, FaultKind::collision);
  EXPECT_EQ(push.joint, 2_joint);
  EXPECT_NEAR(push.onset_s, kOnset_s, 0.01);
  EXPECT_NEAR(push.end_s, kOnset_s + 5 * kPeriod_s, 0.01);
  EXPECT_NEAR(push.size[1], 6.0, 0.5);
  EXPECT_GE(faults[0].alarm_s, kOnset_s);
}

TEST(ExplainCoarse, AMassOnAnInnerLinkIsNamedWithTheLinkAndItsSize) {
  const auto faults = faults_in(day_log(1.03, 9, 0.2));
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].label(), (FaultLabel{FaultKind::payload_change, 2_joint}));
  EXPECT_NEAR(faults[0].claim.size[0], 0.2, 0.03);
  EXPECT_NEAR(faults[0].claim.onset_s, kOnset_s, kPeriod_s);
}

TEST(ExplainCoarse, ATorqueLossRaisesNoAlarmBeforeItsOnset) {
  for (const double left : {0.2, 0.7}) {
    const auto faults = faults_of([&](Log& log) {
      for (std::size_t k = kFaulty; k < log.time.size(); ++k) log.tau[0][k] /= left;
    });
    ASSERT_EQ(faults.size(), 1u) << left;
    EXPECT_EQ(faults[0].claim.kind, FaultKind::torque_loss) << left;
    EXPECT_EQ(faults[0].claim.joint, 1_joint) << left;
    EXPECT_NEAR(faults[0].claim.onset_s, kOnset_s, 0.02) << left;
    EXPECT_NEAR(faults[0].claim.size[0], 1.0 - left, 0.05) << left;
    EXPECT_GE(faults[0].alarm_s, kOnset_s) << left;
  }
}

}  // namespace
}  // namespace faultline
