// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/unjudged_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

std::vector<UnjudgedStretch> stretches_of(const Log& log, const std::vector<LogRun>& runs = {},
                                          int segment = 333) {
  UnjudgedTime unjudged;
  for (int row = 0; row < log.rows(); row += segment)
    unjudged.take(slice(log, row, std::min(row + segment, log.rows())), runs);
  return unjudged.stretches();
}

TEST(UnjudgedTime, ACompleteLogHasNoUnjudgedTime) { EXPECT_TRUE(stretches_of(complete_log()).empty()); }

TEST(UnjudgedTime, AShortStretchWithoutValuesIsNotReported) {
  Log log = complete_log();
  blank(log.q[0], 300, 340);
  blank(log.tau[1], 600, 640);
  EXPECT_TRUE(stretches_of(log).empty());
}

TEST(UnjudgedTime, LongerStretchesNameJointMissingSignalAndTimes) {
  Log log = complete_log();
  blank(log.q[0], 300, 400);
  blank(log.tau[1], 600, 1000);
  const auto found = stretches_of(log);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].joint, 1_joint);
  EXPECT_TRUE(found[0].lacks_position);
  EXPECT_FALSE(found[0].lacks_torque);
  EXPECT_NEAR(found[0].start_s, 2.99, 1e-9);
  EXPECT_NEAR(found[0].end_s, 4.0, 1e-9);
  EXPECT_EQ(found[1].joint, 2_joint);
  EXPECT_TRUE(found[1].lacks_torque);
  EXPECT_EQ(found[1].end_s, log.time.back());
}

TEST(UnjudgedTime, AShortStretchAtTheEndOfTheLogIsReported) {
  Log log = complete_log();
  blank(log.q[1], 980, 1000);
  const auto found = stretches_of(log);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, 2_joint);
  log = complete_log();
  blank(log.q[1], 995, 1000);
  EXPECT_TRUE(stretches_of(log).empty());
}

TEST(UnjudgedTime, MissingRowsAreAStretchOfAllJoints) {
  Log log = slice(complete_log(), 0, 500);
  append(log, slice(complete_log(), 600, 1000));
  const auto found = stretches_of(log);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, Joint());
  EXPECT_NEAR(found[0].end_s - found[0].start_s, 1.01, 1e-9);
}

TEST(UnjudgedTime, TheTimeBetweenTwoRunsIsNotReported) {
  Log log = slice(complete_log(), 0, 500);
  append(log, slice(complete_log(), 600, 1000));
  const std::vector<LogRun> runs = {{.run = 1, .start_s = 0.0, .end_s = 4.99},
                                    {.run = 2, .start_s = log.time[500], .end_s = 9.99}};
  EXPECT_TRUE(stretches_of(log, runs).empty());
}

constexpr int kRows = 2000;

/// Twenty seconds of two joints with position and torque, of which the rows from 1000 on that `is_lost` names
/// lack the values of `channels`.
Log thinned(const std::function<bool(int)>& is_lost,
            const std::function<std::vector<std::vector<double>*>(Log&)>& channels) {
  Log log;
  for (int k = 0; k < kRows; ++k) log.time.push_back(kPeriod_s * k);
  log.q.assign(2, std::vector<double>(kRows, 0.5));
  log.tau = log.q;
  for (std::vector<double>* values : channels(log))
    for (int k = 1000; k < kRows; ++k)
      if (is_lost(k)) (*values)[k] = std::nan("");
  return log;
}

std::vector<std::vector<double>*> all_of(Log& log) {
  return {&log.q[0], &log.q[1], &log.tau[0], &log.tau[1]};
}

TEST(UnjudgedTime, ALogWithEverySecondRowEmptyHasOneStretch) {
  const auto found = stretches_of(thinned([](int k) { return k % 2 == 0; }, all_of));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, Joint());
  EXPECT_NEAR(found[0].start_s, 9.99, 1e-9);
  EXPECT_NEAR(found[0].end_s, 19.99, 1e-9);
  EXPECT_NEAR(found[0].share, 0.5, 0.01);
}

TEST(UnjudgedTime, AJointWithEverySecondTorqueMissingHasOneStretch) {
  const auto found = stretches_of(
      thinned([](int k) { return k % 2 == 0; }, [](Log& log) { return std::vector{&log.tau[1]}; }));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, 2_joint);
  EXPECT_TRUE(found[0].lacks_torque);
  EXPECT_FALSE(found[0].lacks_position);
}

TEST(UnjudgedTime, AFewPercentOfEmptyRowsAreNotReported) {
  EXPECT_TRUE(stretches_of(thinned([](int k) { return k % 20 == 0; }, all_of)).empty());
}

TEST(UnjudgedTime, MissingRowsCountLikeEmptyOnes) {
  const Log whole = thinned([](int) { return false; }, all_of);
  Log log;
  for (int k = 0; k < kRows; ++k)
    if (k < 1000 || k % 45 < 10) append(log, slice(whole, k, k + 1));
  const auto found = stretches_of(log);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, Joint());
  EXPECT_GT(found[0].share, 0.7);
}

TEST(UnjudgedTime, ALongEmptyStretchHasAShareOfOne) {
  const auto found = stretches_of(thinned([](int k) { return k < 1900; }, all_of));
  ASSERT_EQ(found.size(), 2u) << "one for each joint";
  for (const UnjudgedStretch& each : found) EXPECT_EQ(each.share, 1.0);
}

TEST(UnjudgedTime, ScatteredEmptyRowsOfAShortRunAreReported) {
  const Log log = slice(thinned([](int k) { return k % 2 == 0; }, all_of), 900, 1300);
  EXPECT_EQ(stretches_of(log).size(), 1u);
  const Log shorter = slice(log, 0, 130);
  EXPECT_TRUE(stretches_of(shorter).empty()) << "less than a moment of it was not judged";
}

TEST(UnjudgedTime, DoesNotDependOnTheSegments) {
  const Log log = thinned([](int k) { return k % 3 == 0; }, all_of);
  const auto a = stretches_of(log, {}, 7), b = stretches_of(log, {}, kRows);
  ASSERT_EQ(a.size(), 1u);
  ASSERT_EQ(b.size(), 1u);
  EXPECT_EQ(a[0].start_s, b[0].start_s);
  EXPECT_EQ(a[0].share, b[0].share);
}

TEST(UnjudgedTime, ManyShortRunsHaveNoUnjudgedTime) {
  Log log;
  std::vector<LogRun> runs;
  const Log whole = thinned([](int) { return false; }, all_of);
  for (int run = 0; run < 20; ++run) {
    Log piece = slice(whole, 0, 30);
    for (double& t : piece.time) t += 0.7 * run;
    runs.push_back({.run = run + 1, .start_s = piece.time.front(), .end_s = piece.time.back()});
    append(log, piece);
  }
  EXPECT_TRUE(stretches_of(log, runs).empty());
}

}  // namespace
}  // namespace faultline
