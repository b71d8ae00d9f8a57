// SPDX-License-Identifier: MIT
#include "lib/wear/series_trend.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/wear/simulated_series.hpp"

namespace faultline {
namespace {

struct Recovery {
  int covered = 0;  ///< slopes within their intervals
  int flagged = 0;
};

Recovery recovered(const SeriesTruth& truth, int series) {
  Random random(7);
  Recovery result;
  for (int i = 0; i < series; ++i) {
    const SeriesTrend trend = series_trend(simulated_series(truth, random), 1e-9);
    result.covered += trend.slope_ci95[0] <= truth.slope && truth.slope <= trend.slope_ci95[1];
    result.flagged += trend.p < 0.01;
  }
  return result;
}

TEST(SeriesTrend, TheSlopeIsWithinItsIntervalIn95OfHundredSeries) {
  constexpr int kSeries = 2000;
  for (const int logs : {6, 12, 30})
    for (const double between : {0.0, 2.0}) {
      SeriesTruth truth;
      truth.logs = logs;
      truth.slope = 0.3;
      truth.between_std = between;
      EXPECT_GE(recovered(truth, kSeries).covered, 0.945 * kSeries) << logs << " logs, between " << between;
    }
}

TEST(SeriesTrend, LongSeriesDoNotOverstateTheInterval) {
  constexpr int kSeries = 1000;
  SeriesTruth truth;
  truth.logs = 60;
  truth.between_std = 2.0;
  EXPECT_LE(recovered(truth, kSeries).covered, 0.985 * kSeries);
}

TEST(SeriesTrend, SeriesWithoutATrendAreFlaggedAtTheStatedRate) {
  constexpr int kSeries = 2000;
  SeriesTruth truth;
  truth.between_std = 2.0;
  EXPECT_LE(recovered(truth, kSeries).flagged, 0.015 * kSeries);
}

TEST(SeriesTrend, AClearTrendIsFlagged) {
  SeriesTruth truth;
  truth.slope = 1.0;
  EXPECT_GE(recovered(truth, 200).flagged, 195);
}

TEST(SeriesTrend, BeginsAfterTheLastChange) {
  std::vector<SeriesPoint> points;
  for (int i = 0; i < 30; ++i)
    points.push_back({static_cast<double>(i), (i < 15 ? 0.0 : 20.0) + (i % 2 ? 0.2 : 0.0), 0.2});
  const SeriesTrend trend = series_trend(points, 0.001);
  EXPECT_EQ(trend.first, 15);
  EXPECT_NEAR(trend.slope, 0.0, 0.02);
  EXPECT_FALSE(trend.is_trend);
  EXPECT_NEAR(trend.level, 20.1, 0.1);
}

TEST(SeriesTrend, IsNotApplicableToFewLogsAndToLogsOfOneDate) {
  const SeriesTrend few = series_trend({{0, 1, 1}, {1, 2, 1}, {2, 3, 1}}, 0.01);
  EXPECT_EQ(few.not_applicable, "3 logs determine it, 4 are needed");
  EXPECT_TRUE(std::isnan(few.slope));
  const SeriesTrend same = series_trend({{1, 1, 1}, {1, 2, 1}, {1, 3, 1}, {1, 4, 1}}, 0.01);
  EXPECT_EQ(same.not_applicable, "all logs have the same date");
  EXPECT_EQ(series_trend({}, 0.01).not_applicable, "0 logs determine it, 4 are needed");
}

TEST(VarianceBetweenLogs, IsFoundBesideTheStandardDeviations) {
  Random random(3);
  SeriesTruth truth;
  truth.logs = 400;
  truth.between_std = 3.0;
  EXPECT_NEAR(std::sqrt(variance_between_logs(simulated_series(truth, random))), 3.0, 0.3);
  truth.between_std = 0.0;
  EXPECT_LT(std::sqrt(variance_between_logs(simulated_series(truth, random))), 0.6);
}

}  // namespace
}  // namespace faultline
