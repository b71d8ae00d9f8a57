// SPDX-License-Identifier: MIT
#include "lib/balance/sample_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace faultline {
namespace {

constexpr double kPeriod_s = 0.002;

std::vector<int> counted(int rows) {
  std::vector<int> out(rows);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// Stamps of rows at these points, rounded to a millisecond after an error.
std::vector<double> stamps(const std::vector<int>& points, const std::vector<double>& error_ms) {
  std::vector<double> out;
  for (std::size_t k = 0; k < points.size(); ++k)
    out.push_back(1e-3 * std::round(2.0 * points[k] + error_ms[k % error_ms.size()]));
  return out;
}

TEST(SampleGrid, ExactStampsStandWhereTheyAre) {
  std::vector<double> time;
  for (int k = 0; k < 100; ++k) time.push_back(3.0 + kPeriod_s * k);
  const SampleGrid grid = sample_grid(time, kPeriod_s);
  EXPECT_EQ(grid.point, counted(100));
  EXPECT_NEAR(grid.start_s, 3.0, 1e-12);
  EXPECT_NEAR(grid.period_s, kPeriod_s, 1e-12);
}

TEST(SampleGrid, StampsThatWobbleByHalfAPeriodLoseNoRow) {
  const std::vector<double> error_ms{0.0, 0.8, -0.7, 0.0, 1.0, 0.2, -0.9};
  EXPECT_EQ(sample_grid(stamps(counted(200), error_ms), kPeriod_s).point, counted(200));
}

TEST(SampleGrid, LostRowsLeaveTheirPointsFree) {
  std::vector<int> points = counted(200);
  points.erase(points.begin() + 120);
  points.erase(points.begin() + 50, points.begin() + 53);
  EXPECT_EQ(sample_grid(stamps(points, {0.0, 0.3, -0.3}), kPeriod_s).point, points);
}

TEST(SampleGrid, OfTwoRowsWithOneStampTheFirstCounts) {
  std::vector<int> points = counted(100), twice = points;
  twice.insert(twice.begin() + 40, 40);
  points.insert(points.begin() + 41, -1);
  EXPECT_EQ(sample_grid(stamps(twice, {0.0}), kPeriod_s).point, points);
}

TEST(SampleGrid, AClockThatRunsFastLosesNoRow) {
  std::vector<double> time;
  for (int k = 0; k < 20000; ++k) time.push_back(1.0001 * kPeriod_s * k);
  const SampleGrid grid = sample_grid(time, kPeriod_s);
  EXPECT_EQ(grid.point, counted(20000));
  EXPECT_NEAR(grid.period_s, 1.0001 * kPeriod_s, 1e-9);
}

}  // namespace
}  // namespace faultline
