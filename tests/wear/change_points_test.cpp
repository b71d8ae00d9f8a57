// SPDX-License-Identifier: MIT
#include "lib/wear/change_points.hpp"

#include <gtest/gtest.h>

#include "tests/wear/simulated_series.hpp"

namespace faultline {
namespace {

std::vector<SeriesChange> changes_of(const std::vector<SeriesPoint>& points, double false_alarms) {
  return change_points(without_outliers(points).points, false_alarms);
}

int with_changes(const SeriesTruth& truth, double false_alarms, int series) {
  Random random(static_cast<std::uint64_t>(truth.logs));
  int found = 0;
  for (int i = 0; i < series; ++i)
    found += !changes_of(simulated_series(truth, random), false_alarms).empty();
  return found;
}

/// Levels that alternate by 0.2, from which only `jumps` (place, size) differ.
std::vector<SeriesPoint> quiet_series(int logs, const std::vector<std::pair<int, double>>& jumps) {
  std::vector<SeriesPoint> points;
  for (int i = 0; i < logs; ++i) {
    points.push_back({static_cast<double>(i), i % 2 ? 0.2 : 0.0, 0.2});
    for (const auto& [place, size] : jumps)
      if (i >= place) points.back().value += size;
  }
  return points;
}

TEST(ChangePoints, HealthySeriesOfAnyLengthKeepTheStatedRateOfFalseAlarms) {
  constexpr int kSeries = 2000;
  for (const int logs : {6, 8, 12, 20, 40})
    for (const double between : {0.0, 2.0}) {
      SeriesTruth truth;
      truth.logs = logs;
      truth.between_std = between;
      EXPECT_LE(with_changes(truth, 0.05, kSeries), 0.05 * kSeries) << logs << " logs";
    }
}

TEST(ChangePoints, ASteadyTrendIsRarelyTakenForAChange) {
  constexpr int kSeries = 1000;
  for (const double slope : {0.05, 0.1, 0.2, 0.4, 0.8, 3.0}) {
    SeriesTruth truth;
    truth.slope = slope;
    EXPECT_LE(with_changes(truth, 0.01, kSeries), 0.06 * kSeries) << slope;
  }
}

TEST(ChangePoints, CorrelatedLogsRaiseTheRateOnlySomewhat) {
  constexpr int kSeries = 1000;
  SeriesTruth truth;
  truth.between_std = 2.0;
  truth.correlation = 0.5;
  EXPECT_LE(with_changes(truth, 0.01, kSeries), 0.06 * kSeries);
}

TEST(ChangePoints, AJumpOfFiveStandardDeviationsIsFoundWithItsPlaceAndSize) {
  constexpr int kSeries = 500;
  SeriesTruth truth;
  truth.logs = 30;
  truth.jump = 8.0;  // five times the scatter of a log
  truth.jump_at = 12;
  Random random(1);
  int found = 0, near = 0, within = 0, covered = 0;
  for (int i = 0; i < kSeries; ++i) {
    const std::vector<SeriesChange> changes = changes_of(simulated_series(truth, random), 0.001);
    if (changes.size() != 1) continue;
    const SeriesChange& change = changes.front();
    ++found;
    near += std::abs(change.first - truth.jump_at) <= 1;
    within += change.first_between[0] <= truth.jump_at && truth.jump_at <= change.first_between[1];
    covered += change.ci95[0] <= truth.jump && truth.jump <= change.ci95[1];
  }
  EXPECT_GE(found, 0.95 * kSeries);
  EXPECT_GE(near, 0.98 * found);
  EXPECT_GE(within, 0.95 * found);
  EXPECT_GE(covered, 0.92 * found);
}

TEST(ChangePoints, OneOutlierHoweverLargeIsNoChange) {
  for (const int place : {0, 1, 10, 18, 19}) {
    std::vector<SeriesPoint> points = quiet_series(20, {});
    points[static_cast<std::size_t>(place)].value += 1000.0;
    EXPECT_TRUE(changes_of(points, 0.01).empty()) << place;
    EXPECT_EQ(without_outliers(points).outliers, std::vector<int>{place});
  }
}

TEST(ChangePoints, AnOutlierHidesNoChange) {
  std::vector<SeriesPoint> points = quiet_series(20, {{10, 5.0}});
  points[4].value += 1000.0;
  const std::vector<SeriesChange> changes = changes_of(points, 0.001);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].first, 10);
  EXPECT_NEAR(changes[0].size, 5.0, 0.3);
}

TEST(ChangePoints, AChangeAndItsReturnAreTwo) {
  const std::vector<SeriesChange> changes = changes_of(quiet_series(40, {{12, 3.0}, {24, -3.0}}), 0.001);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].first, 12);
  EXPECT_NEAR(changes[0].size, 3.0, 0.2);
  EXPECT_EQ(changes[1].first, 24);
  EXPECT_NEAR(changes[1].size, -3.0, 0.2);
}

TEST(ChangePoints, ARepairInASteadyTrendIsOneChangeBesideTheTrend) {
  std::vector<SeriesPoint> points = quiet_series(40, {{20, -8.0}});
  for (std::size_t i = 0; i < points.size(); ++i) points[i].value += 0.4 * static_cast<double>(i);
  const std::vector<SeriesChange> changes = changes_of(points, 0.001);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].first, 20);
  EXPECT_TRUE(changes[0].beside_trend);
  EXPECT_NEAR(changes[0].size, -8.0, 0.3);
}

TEST(ChangePoints, FewerThanThreeLogsOnASideAreNoChange) {
  EXPECT_TRUE(changes_of(quiet_series(5, {{3, 50.0}}), 0.05).empty());
  EXPECT_TRUE(changes_of(quiet_series(20, {{18, 50.0}}), 0.05).empty());
  EXPECT_EQ(changes_of(quiet_series(20, {{17, 50.0}}), 0.05).size(), 1u);
}

TEST(ChangePoints, EqualValuesHaveNone) {
  std::vector<SeriesPoint> points(20, {0.0, 1.0, 0.5});
  EXPECT_TRUE(changes_of(points, 0.05).empty());
}

TEST(CorrelationFactor, IsOneForAlternatingAndLargeForSlowResiduals) {
  std::vector<double> alternating, slow;
  for (int i = 0; i < 40; ++i) {
    alternating.push_back(i % 2 ? 1.0 : -1.0);
    slow.push_back(i < 20 ? 1.0 : -1.0);
  }
  EXPECT_DOUBLE_EQ(correlation_factor(alternating, 2), 1.0);
  EXPECT_GT(correlation_factor(slow, 2), 10.0);
}

}  // namespace
}  // namespace faultline
