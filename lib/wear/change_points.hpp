// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "lib/wear/weighted_series.hpp"

namespace faultline {

/// A series changes its level between two logs, beyond what chance or a steady trend explains.
struct SeriesChange {
  int first = 0;  ///< index of the first point after it
  /// Range of `first` whose likelihood is within 95 % of the best one.
  std::array<int, 2> first_between = {0, 0};
  double size = 0.0;  ///< level after it minus level before it, beside the trend if `beside_trend`
  std::array<double, 2> ci95 = {0.0, 0.0};
  double p = 1.0;             ///< bound of the probability of such a change in a series without any
  bool beside_trend = false;  ///< the series has a slope before and after it
};

/// Fewest logs on each side of a change: one outlier is no change, nor are two.
inline constexpr int kLogsBesideChange = 3;

/// Returns the changes of a series, by place; the probability that a series without a change has one is at
/// most `false_alarms`. Recursively looks for one step, for a stretch of another level, and for a step on a
/// line; each is tested by Student's t over all its places (Bonferroni), with the scatter that it leaves
/// over, enlarged by the correlation of neighbouring logs. A step must also explain the series better than a
/// level, a line and a parabola (Schwarz 1978), so that a trend is no change. Outliers are to be limited
/// before (without_outliers()).
std::vector<SeriesChange> change_points(const std::vector<SeriesPoint>& points, double false_alarms);

/// Returns the points with each value that is more than some standard deviations from the median of its
/// neighbours replaced by that median; `outliers` lists their indices. A level that lasts three logs is none.
struct LimitedSeries {
  std::vector<SeriesPoint> points;
  std::vector<int> outliers;
};
LimitedSeries without_outliers(const std::vector<SeriesPoint>& points);

/// Returns the factor by which the correlation of neighbours enlarges the variance of a mean, at least 1,
/// from residuals of a fit with so many parameters, divided by their standard deviations.
double correlation_factor(const std::vector<double>& residuals, int parameters);

}  // namespace faultline
