// SPDX-License-Identifier: MIT
#include "lib/balance/sample_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "lib/core/random.hpp"

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

TEST(SampleGrid, ExactTimeStampsKeepTheirPlaces) {
  std::vector<double> time;
  for (int k = 0; k < 100; ++k) time.push_back(3.0 + kPeriod_s * k);
  const SampleGrid grid = sample_grid(time, kPeriod_s);
  EXPECT_EQ(grid.point, counted(100));
  EXPECT_NEAR(grid.start_s, 3.0, 1e-12);
  EXPECT_NEAR(grid.period_s, kPeriod_s, 1e-12);
}

TEST(SampleGrid, TimeStampsWithAJitterOfHalfAPeriodLoseNoRow) {
  const std::vector<double> error_ms{0.0, 0.8, -0.7, 0.0, 1.0, 0.2, -0.9};
  EXPECT_EQ(sample_grid(stamps(counted(200), error_ms), kPeriod_s).point, counted(200));
}

TEST(SampleGrid, ThePeriodIsFoundFromAnInexactStartDespiteJitter) {
  Random random(3);
  std::vector<double> time;
  for (int k = 0; k < 2500; ++k) time.push_back(kPeriod_s * (k + 0.1 * random.normal()));
  for (const double off : {-0.01, -0.004, 0.004, 0.01}) {
    const SampleGrid grid = sample_grid(time, (1.0 + off) * kPeriod_s);
    EXPECT_EQ(grid.point, counted(2500)) << off;
    EXPECT_NEAR(grid.period_s, kPeriod_s, 1e-5 * kPeriod_s);
  }
}

TEST(SampleGrid, LostRowsLeaveTheirGridPointsEmpty) {
  std::vector<int> points = counted(200);
  points.erase(points.begin() + 120);
  points.erase(points.begin() + 50, points.begin() + 53);
  EXPECT_EQ(sample_grid(stamps(points, {0.0, 0.3, -0.3}), kPeriod_s).point, points);
}

TEST(SampleGrid, TheFirstOfTwoRowsWithOneTimeStampIsUsed) {
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

/// Positions of two joints, one of which rests, at these points.
std::vector<std::vector<double>> positions_at(const std::vector<int>& points) {
  std::vector<std::vector<double>> out(2);
  for (const int p : points) {
    out[0].push_back(std::sin(1e-3 * p) + 1e-5 * ((p * 7919) % 11 - 5) / 5.0);
    out[1].push_back(0.3);
  }
  return out;
}

TEST(SampleGrid, ARowWhosePositionContradictsItsTimeStampIsLeftOut) {
  std::vector<int> points = counted(300);
  points.erase(points.begin() + 150);
  std::vector<int> stamped = points;
  stamped[149] = 150;  // the lost row's: the stamp looks right
  const std::vector<double> time = stamps(stamped, {0.0, 0.4, 0.6, 0.2});
  EXPECT_EQ(sample_grid(time, kPeriod_s).point[149], 150);
  const SampleGrid grid = sample_grid(time, kPeriod_s, row_steps(positions_at(points)));
  points[149] = -1;  // between its own point and that of its stamp
  EXPECT_EQ(grid.point, points);
}

TEST(SampleGrid, JointsThatAccelerateFastLoseNoRow) {
  std::vector<double> time;
  std::vector<std::vector<double>> positions(2);
  for (int k = 0; k < 500; ++k) {
    time.push_back(0.01 * k);
    positions[0].push_back(0.8 * std::sin(40.0 * time.back()));
    positions[1].push_back(0.3 * std::sin(90.0 * time.back()));
  }
  EXPECT_EQ(sample_grid(time, 0.01, row_steps(positions)).point, counted(500));
}

TEST(SampleGrid, JitterIsFoundOnlyInInexactTimeStamps) {
  EXPECT_FALSE(stamps_jitter(stamps(counted(300), {0.0}), kPeriod_s));
  EXPECT_TRUE(stamps_jitter(stamps(counted(300), {0.0, 0.8, -0.7}), kPeriod_s));
}

TEST(SampleGrid, AJumpOfAPositionMovesNoRow) {
  const std::vector<int> points = counted(300);
  std::vector<std::vector<double>> positions = positions_at(points);
  for (int k = 140; k < 300; ++k) positions[0][k] += 0.01;
  const std::vector<double> time = stamps(points, {0.0, 0.4, -0.6, 0.2});
  EXPECT_EQ(sample_grid(time, kPeriod_s, row_steps(positions)).point, points);
}

}  // namespace
}  // namespace faultline
