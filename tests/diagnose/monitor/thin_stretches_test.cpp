// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/thin_stretches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace faultline {
namespace {

constexpr double kStep_s = 0.01;
constexpr int kRows = 2000;

/// Twenty seconds of two joints with position and torque, of which the rows from 1000 on that `is_lost` names
/// lack the values of `channels`.
Log thinned(const std::function<bool(int)>& is_lost,
            const std::function<std::vector<std::vector<double>*>(Log&)>& channels) {
  Log log;
  for (int k = 0; k < kRows; ++k) log.time.push_back(kStep_s * k);
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

std::vector<UnjudgedStretch> thin_of(const Log& log, int segment = 333, std::vector<LogRun> runs = {}) {
  ThinStretches thin;
  for (int row = 0; row < log.rows(); row += segment)
    thin.take(slice(log, row, std::min(row + segment, log.rows())), runs);
  return thin.stretches();
}

TEST(ThinStretches, EverySecondEmptyRowIsOneStretchOfTheRows) {
  const auto found = thin_of(thinned([](int k) { return k % 2 == 0; }, all_of));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, 0);
  EXPECT_NEAR(found[0].start_s, 9.99, 1e-9);
  EXPECT_NEAR(found[0].end_s, 19.99, 1e-9);
  EXPECT_NEAR(found[0].share, 0.5, 0.01);
}

TEST(ThinStretches, EverySecondTorqueOfAJointIsAStretchOfThatJoint) {
  const auto found =
      thin_of(thinned([](int k) { return k % 2 == 0; }, [](Log& log) { return std::vector{&log.tau[1]}; }));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, 2);
  EXPECT_TRUE(found[0].lacks_torque);
  EXPECT_FALSE(found[0].lacks_position);
}

TEST(ThinStretches, AFewPerCentOfEmptyRowsAreNone) {
  EXPECT_TRUE(thin_of(thinned([](int k) { return k % 20 == 0; }, all_of)).empty());
}

TEST(ThinStretches, MissingRowsCountLikeEmptyOnes) {
  const Log whole = thinned([](int) { return false; }, all_of);
  Log log;
  for (int k = 0; k < kRows; ++k)
    if (k < 1000 || k % 45 < 10) append(log, slice(whole, k, k + 1));
  const auto found = thin_of(log);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].joint, 0);
  EXPECT_GT(found[0].share, 0.7);
}

TEST(ThinStretches, APieceLongerThanAMomentIsLeftToTheLongStretches) {
  EXPECT_TRUE(thin_of(thinned([](int k) { return k < 1900; }, all_of)).empty());
}

TEST(ThinStretches, OfAShortRunAQuarterCounts) {
  const Log log = slice(thinned([](int k) { return k % 2 == 0; }, all_of), 900, 1300);
  EXPECT_EQ(thin_of(log).size(), 1u);
  const Log shorter = slice(log, 0, 130);
  EXPECT_TRUE(thin_of(shorter).empty()) << "less than a moment of it was not judged";
}

TEST(ThinStretches, DoNotDependOnTheSegments) {
  const Log log = thinned([](int k) { return k % 3 == 0; }, all_of);
  const auto a = thin_of(log, 7), b = thin_of(log, kRows);
  ASSERT_EQ(a.size(), 1u);
  ASSERT_EQ(b.size(), 1u);
  EXPECT_EQ(a[0].start_s, b[0].start_s);
  EXPECT_EQ(a[0].share, b[0].share);
}

TEST(ThinStretches, WhatLiesBetweenTwoRunsIsNone) {
  Log log;
  std::vector<LogRun> runs;
  const Log whole = thinned([](int) { return false; }, all_of);
  for (int run = 0; run < 20; ++run) {
    Log piece = slice(whole, 0, 30);
    for (double& t : piece.time) t += 0.7 * run;
    runs.push_back({.run = run + 1, .start_s = piece.time.front(), .end_s = piece.time.back()});
    append(log, piece);
  }
  EXPECT_TRUE(thin_of(log, 333, runs).empty());
}

}  // namespace
}  // namespace faultline
