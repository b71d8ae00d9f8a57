// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace faultline {

/// The value of one log in a series.
struct SeriesPoint {
  double at = 0.0;     ///< days, or the place of the log in its order
  double value = 0.0;  ///< estimate
  double std = 0.0;    ///< its standard deviation, above 0
};

/// A stretch of a series with the weight of each point, 1 / variance. All fits below are weighted least
/// squares.
struct WeightedSeries {
  std::vector<double> x, y, weight;

  int size() const { return static_cast<int>(y.size()); }
  /// Returns the points from `begin` to before `end`.
  WeightedSeries part(int begin, int end) const;
};

/// A straight line through a series.
struct LineFit {
  double mean_x = 0.0;    ///< weighted
  double level = 0.0;     ///< value at mean_x
  double slope = 0.0;     ///< 0 if all x are equal
  double spread_x = 0.0;  ///< weighted sum of squares of x - mean_x; slope has the variance 1 / spread_x
  double chi_square = 0.0;
  std::vector<double> residual;

  double at(double x) const { return level + slope * (x - mean_x); }
};

LineFit fit_level(const WeightedSeries& series);
LineFit fit_line(const WeightedSeries& series);

/// Returns the weighted residual sum of squares of a parabola.
double parabola_chi_square(const WeightedSeries& series);

/// Returns the variance between logs, beyond the standard deviations of the points, with which the points
/// scatter about their line as much as they should (Paule and Mandel 1982); 0 if they scatter less. It needs
/// at least three points.
double variance_between_logs(const std::vector<SeriesPoint>& points);

/// Returns the points with the weights 1 / (std^2 + between).
WeightedSeries weighted(const std::vector<SeriesPoint>& points, double between);

/// Returns the value that |T| of Student's t exceeds with this probability.
double student_limit(double probability, int degrees);

}  // namespace faultline
