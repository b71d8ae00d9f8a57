// SPDX-License-Identifier: MIT
#include "lib/log/recorder/stopped_columns.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/core/random.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {
namespace {

constexpr int kRows = 800, kFrom = 300;

/// Two joints in motion, measured with noise, at this period.
Log moving(double step_s) {
  Random random(9);
  Log log;
  log.q.resize(2), log.dq.resize(2), log.tau.resize(2);
  for (int i = 0; i < kRows; ++i) {
    const double t = step_s * i;
    log.time.push_back(t);
    for (int j = 0; j < 2; ++j) {
      const double rate = 1.0 + j;
      log.q[j].push_back(std::sin(rate * t) + 1e-4 * random.normal());
      log.dq[j].push_back(rate * std::cos(rate * t) + 1e-3 * random.normal());
      log.tau[j].push_back(3.0 * std::sin(rate * t) + 1e-2 * random.normal());
    }
  }
  return log;
}

void freeze(JointSignals& signals, int end = kRows) {
  for (std::vector<double>& joint : signals)
    std::fill(joint.begin() + kFrom, joint.begin() + end, joint[kFrom - 1]);
}

void zero(JointSignals& signals, int end = kRows) {
  for (std::vector<double>& joint : signals) std::fill(joint.begin() + kFrom, joint.begin() + end, 0.0);
}

struct Read {
  Log log;
  Issues issues;
};

Read read(const Log& log, int segment_rows = 4096) {
  const auto source = without_stopped_columns(std::make_unique<MemorySource>(log, "log", segment_rows));
  Read out;
  out.log = read_all(*source);
  out.issues = source->issues();
  return out;
}

int missing(const std::vector<double>& values) {
  return static_cast<int>(
      std::count_if(values.begin(), values.end(), [](double value) { return std::isnan(value); }));
}

TEST(StoppedColumns, ACompleteLogKeepsItsValues) {
  const Log log = moving(0.01);
  const Read out = read(log);
  EXPECT_EQ(out.log.q, log.q);
  EXPECT_EQ(out.log.tau, log.tau);
  EXPECT_TRUE(out.issues.empty());
}

TEST(StoppedColumns, PositionsThatFreezeWhileVelocitiesChangeAreMissing) {
  for (const double step_s : {0.01, 0.073})
    for (const int end : {kRows, kFrom + 200}) {
      Log log = moving(step_s);
      freeze(log.q, end);
      const Read out = read(log);
      ASSERT_NE(out.issues.find("positions_stopped"), nullptr);
      EXPECT_EQ(out.issues.find("positions_stopped")->first_row, kFrom + 1);
      EXPECT_EQ(missing(out.log.q[0]), end - kFrom);
      EXPECT_EQ(missing(out.log.dq[0]), 0);
      EXPECT_EQ(missing(out.log.tau[0]), 0);
    }
}

TEST(StoppedColumns, PositionsAndVelocitiesThatFreezeTogetherAreMissing) {
  Log log = moving(0.01);
  freeze(log.q);
  freeze(log.dq);
  const Read out = read(log);
  EXPECT_EQ(missing(out.log.q[1]), kRows - kFrom);
  EXPECT_EQ(missing(out.log.dq[1]), kRows - kFrom);
}

TEST(StoppedColumns, VelocitiesThatAreZeroWhilePositionsMoveAreMissing) {
  Log log = moving(0.01);
  zero(log.dq);
  const Read out = read(log);
  EXPECT_EQ(missing(out.log.dq[0]), kRows - kFrom);
  EXPECT_EQ(missing(out.log.q[0]), 0);
  ASSERT_NE(out.issues.find("velocities_stopped"), nullptr);
}

TEST(StoppedColumns, TorquesThatAreZeroOrFreezeWhileTheJointsAccelerateAreMissing) {
  for (const bool is_zero : {false, true}) {
    Log log = moving(0.01);
    if (is_zero)
      zero(log.tau);
    else
      freeze(log.tau);
    const Read out = read(log);
    EXPECT_EQ(missing(out.log.tau[0]), kRows - kFrom);
    EXPECT_EQ(missing(out.log.q[0]), 0);
    ASSERT_NE(out.issues.find("torques_stopped"), nullptr);
  }
}

TEST(StoppedColumns, ARobotAtRestKeepsItsValues) {
  Log log = moving(0.01);
  freeze(log.q);
  zero(log.dq);
  freeze(log.tau);
  const Read out = read(log);
  EXPECT_EQ(out.log.q, log.q);
  EXPECT_EQ(out.log.dq, log.dq);
  EXPECT_EQ(out.log.tau, log.tau);
  EXPECT_TRUE(out.issues.empty());
}

TEST(StoppedColumns, AFaultySensorOfOneJointIsNotAStoppedColumn) {
  Log log = moving(0.01);
  std::fill(log.q[1].begin() + kFrom, log.q[1].end(), log.q[1][kFrom - 1]);
  std::fill(log.tau[0].begin() + kFrom, log.tau[0].end(), 0.0);
  EXPECT_TRUE(read(log).issues.empty());
}

TEST(StoppedColumns, TorquesThatNeverChangeAreNotReported) {
  Log log = moving(0.01);
  for (std::vector<double>& joint : log.tau) std::fill(joint.begin(), joint.end(), 0.0);
  EXPECT_TRUE(read(log).issues.empty());
}

TEST(StoppedColumns, DoNotDependOnTheSegments) {
  Log log = moving(0.01);
  freeze(log.q, 500);
  zero(log.tau, 600);
  const Read whole = read(log), parts = read(log, 7);
  for (int j = 0; j < 2; ++j)
    for (int k = 0; k < kRows; ++k) {
      EXPECT_EQ(std::isnan(whole.log.q[j][k]), std::isnan(parts.log.q[j][k])) << k;
      EXPECT_EQ(std::isnan(whole.log.tau[j][k]), std::isnan(parts.log.tau[j][k])) << k;
    }
  EXPECT_EQ(whole.issues.find("positions_stopped")->count, parts.issues.find("positions_stopped")->count);
}

}  // namespace
}  // namespace faultline
