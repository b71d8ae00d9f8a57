// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "apps/inspection/inspection.hpp"

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.0041;

/// q1, q2, dq1 and dq2 of a log that lost its time; the velocities times `factor`.
RawBlock block_without_clock(double factor_of_second = 1.0) {
  RawBlock block;
  block.rows = 2000;
  block.columns.resize(4);
  for (int i = 0; i < block.rows; ++i) {
    const double t = kPeriod_s * i;
    block.columns[0].push_back(std::sin(2.0 * t));
    block.columns[1].push_back(0.5 * std::sin(3.0 * t));
    block.columns[2].push_back(2.0 * std::cos(2.0 * t));
    block.columns[3].push_back(factor_of_second * 1.5 * std::cos(3.0 * t));
  }
  return block;
}

std::vector<RawColumn> table() { return {{"q1", ""}, {"q2", ""}, {"dq1", ""}, {"dq2", ""}}; }

TEST(RowClock, TheSamplePeriodOfALogWithoutClockComesFromPositionAndVelocity) {
  RowClock clock(table(), {}, "log.csv");
  clock.add(block_without_clock());
  const auto estimate = clock.estimate();
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(estimate->period_s, kPeriod_s, 1e-3 * kPeriod_s);
}

TEST(RowClock, JointsThatDisagreeGiveNoSamplePeriod) {
  RowClock clock(table(), {}, "log.csv");
  clock.add(block_without_clock(57.3));
  EXPECT_FALSE(clock.estimate());
}

TEST(RowClock, ALogWithAClockOrWithoutPositionsHasNoEstimate) {
  std::vector<RawColumn> with_time = table();
  with_time.push_back({"t", ""});
  for (const auto& columns : {with_time, std::vector<RawColumn>{{"alpha", ""}}}) {
    RowClock clock(columns, {}, "log.csv");
    EXPECT_FALSE(clock.estimate());
  }
}

}  // namespace
}  // namespace faultline
