// SPDX-License-Identifier: MIT
#include "lib/diagnose/stop/stop_signs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

constexpr double kLimit = 100.0;  // nats

/// Rows every 10 ms whose squares are 1, but `square` from row `first` to before row `end`.
BalanceCourse course_with(double square, int first, int end, int rows = 400) {
  BalanceCourse course;
  course.square = Eigen::MatrixXd::Ones(rows, 1);
  for (int k = 0; k < rows; ++k) course.time_s.push_back(0.01 * k);
  course.square.col(0).segment(first, end - first).setConstant(square);
  return course;
}

TEST(BalanceDeviations, AHealthyCourseHasNone) {
  EXPECT_TRUE(balance_deviations(course_with(1.0, 0, 0), 0, kLimit).empty());
}

TEST(BalanceDeviations, AStepStartsAtItsFirstRow) {
  const auto found = balance_deviations(course_with(25.0, 200, 400), 0, kLimit);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].start_s, 2.0);
  EXPECT_DOUBLE_EQ(found[0].last_s, 3.99);
}

TEST(BalanceDeviations, AStepTooSmallForTheLimitIsNone) {
  // Each row gives 0.5 * 5 - 1.5 = 1 nat: 99 of them stay below the limit, 101 do not.
  EXPECT_TRUE(balance_deviations(course_with(5.0, 200, 299), 0, kLimit).empty());
  EXPECT_EQ(balance_deviations(course_with(5.0, 200, 301), 0, kLimit).size(), 1u);
}

TEST(BalanceDeviations, RowsWithoutWeightDoNotCount) {
  BalanceCourse course = course_with(25.0, 200, 400);
  course.square.col(0).segment(200, 50).setConstant(std::nan(""));
  const auto found = balance_deviations(course, 0, kLimit);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].start_s, 2.5);
}

TEST(SamplesByChance, AreThoseOfPoissonsDistribution) {
  // Mean 1: P(X >= 1) = 0.632, P(X >= 2) = 0.264, P(X >= 5) = 0.00366, P(X >= 6) = 0.000594.
  EXPECT_EQ(samples_by_chance(100, 99, 0.7), 1);
  EXPECT_EQ(samples_by_chance(100, 99, 0.3), 2);
  EXPECT_EQ(samples_by_chance(100, 99, 0.004), 5);
  EXPECT_EQ(samples_by_chance(100, 99, 0.003), 6);
}

TEST(SampleDeviations, SuccessiveBlocksAreOne) {
  std::vector<double> time, magnitude(100, 1.0);
  for (int k = 0; k < 100; ++k) time.push_back(k);
  for (int k = 62; k < 88; ++k) magnitude[k] = 6.0;
  const auto found = sample_deviations(time, magnitude, 5.0, 10, 3);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_DOUBLE_EQ(found[0].start_s, 62.0);
  EXPECT_DOUBLE_EQ(found[0].last_s, 87.0);
}

TEST(SampleDeviations, FewSamplesBeyondAreChance) {
  std::vector<double> time, magnitude(100, 1.0);
  for (int k = 0; k < 100; ++k) time.push_back(k);
  magnitude[65] = magnitude[67] = 6.0;
  EXPECT_TRUE(sample_deviations(time, magnitude, 5.0, 10, 3).empty());
}

TEST(LastingDeviation, ReachesBackOverShortPauses) {
  const std::vector<Deviation> found = {{1.0, 2.0}, {5.0, 6.0}, {6.5, 7.0}, {7.9, 9.8}};
  const auto lasting = lasting_deviation(found, 10.0, 1.0);
  ASSERT_TRUE(lasting);
  EXPECT_DOUBLE_EQ(lasting->start_s, 5.0);
  EXPECT_DOUBLE_EQ(lasting->last_s, 9.8);
}

TEST(LastingDeviation, OneThatCeasedBeforeTheLastMomentIsNone) {
  EXPECT_FALSE(lasting_deviation({{5.0, 8.9}}, 10.0, 1.0));
  EXPECT_TRUE(lasting_deviation({{5.0, 9.1}}, 10.0, 1.0));
  EXPECT_FALSE(lasting_deviation({}, 10.0, 1.0));
}

}  // namespace
}  // namespace faultline
