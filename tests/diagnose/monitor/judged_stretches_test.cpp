// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/judged_stretches.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.01;

/// Ten seconds of two joints with position and torque.
Log complete_log() {
  Log log;
  for (int k = 0; k < 1000; ++k) log.time.push_back(kPeriod_s * k);
  log.q.assign(2, std::vector<double>(1000, 0.5));
  log.tau = log.q;
  return log;
}

void blank(std::vector<double>& values, int begin, int end) {
  std::fill(values.begin() + begin, values.begin() + end, std::nan(""));
}

std::vector<UnjudgedStretch> stretches_of(const Log& log, const std::vector<LogRun>& runs = {}) {
  JudgedStretches stretches;
  for (int row = 0; row < log.rows(); row += 333)
    stretches.take(slice(log, row, std::min(row + 333, log.rows())), runs);
  return stretches.longer_than_a_moment(kPeriod_s);
}

TEST(JudgedStretches, ACompleteLogHasNone) { EXPECT_TRUE(stretches_of(complete_log()).empty()); }

TEST(JudgedStretches, AMomentWithoutValuesIsNone) {
  Log log = complete_log();
  blank(log.q[0], 300, 340);
  blank(log.tau[1], 600, 640);
  EXPECT_TRUE(stretches_of(log).empty());
}

TEST(JudgedStretches, LongerOnesSayWhichJointLacksWhatAndWhen) {
  Log log = complete_log();
  blank(log.q[0], 300, 400);
  blank(log.tau[1], 600, 1000);
  const auto found = stretches_of(log);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].joint, 1);
  EXPECT_TRUE(found[0].lacks_position);
  EXPECT_FALSE(found[0].lacks_torque);
  EXPECT_NEAR(found[0].start_s, 2.99, 1e-9);
  EXPECT_NEAR(found[0].end_s, 4.0, 1e-9);
  EXPECT_EQ(found[1].joint, 2);
  EXPECT_TRUE(found[1].lacks_torque);
  EXPECT_EQ(found[1].end_s, log.time.back());
}

TEST(JudgedStretches, AtTheEndTenSamplesAreEnoughForTheJointIsNotJudgedAgain) {
  Log log = complete_log();
  blank(log.q[1], 980, 1000);
  const auto found = stretches_of(log);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, 2);
  EXPECT_TRUE(found[0].is_last);
  log = complete_log();
  blank(log.q[1], 995, 1000);
  EXPECT_TRUE(stretches_of(log).empty());
}

TEST(JudgedStretches, MissingRowsAreAStretchOfAllJoints) {
  Log log = slice(complete_log(), 0, 500);
  append(log, slice(complete_log(), 600, 1000));
  const auto found = stretches_of(log);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, 0);
  EXPECT_NEAR(found[0].end_s - found[0].start_s, 1.01, 1e-9);
}

TEST(JudgedStretches, WhatLiesBetweenTwoRunsIsNone) {
  Log log = slice(complete_log(), 0, 500);
  append(log, slice(complete_log(), 600, 1000));
  const std::vector<LogRun> runs = {{.run = 1, .start_s = 0.0, .end_s = 4.99},
                                    {.run = 2, .start_s = log.time[500], .end_s = 9.99}};
  EXPECT_TRUE(stretches_of(log, runs).empty());
}

}  // namespace
}  // namespace faultline
