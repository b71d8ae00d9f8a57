// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "lib/wear/change_points.hpp"

namespace faultline {

/// How a value went from log to log: a line since the last change, and the changes.
struct SeriesTrend {
  std::string not_applicable;  ///< why there is no trend, a sentence; empty if there is one
  int first = 0;               ///< index of the first point of the trend: after the last change
  double level = std::numeric_limits<double>::quiet_NaN();  ///< of the line at the last point
  double slope = std::numeric_limits<double>::quiet_NaN();  ///< per unit of SeriesPoint::at
  std::array<double, 2> slope_ci95 = {slope, slope};
  double p = 1.0;            ///< probability of so large a slope without a trend
  bool is_trend = false;     ///< p is below the rate of false alarms
  double between_std = 0.0;  ///< from log to log, beyond the standard deviations of the points
  std::vector<SeriesChange> changes;
  std::vector<int> outliers;  ///< indices of the points that a median replaces
};

/// Fewest logs that give a trend with an interval.
inline constexpr int kLogsForTrend = 4;

/// Returns trend and changes of a series that is ordered by `at`. The line is fitted by weighted least
/// squares with a variance between the logs; its interval is that of Student's t, wider if neighbours are
/// correlated. `false_alarms` is the probability of a change in a series without any, and of `is_trend` in
/// one without a trend.
SeriesTrend series_trend(const std::vector<SeriesPoint>& points, double false_alarms);

}  // namespace faultline
