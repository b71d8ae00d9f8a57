// SPDX-License-Identifier: MIT
#include "lib/wear/weighted_series.hpp"

#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

/// Halvings of an interval until nothing changes in a double.
constexpr int kHalvings = 80;

/// Largest value that student_limit() returns; a probability that needs more is never reached.
constexpr double kLargestT = 1e12;

/// Share of its squares that a regressor must keep beside the others to count as one of its own.
constexpr double kOwnShare = 1e-9;

double total_weight(const WeightedSeries& s) {
  double sum = 0.0;
  for (const double w : s.weight) sum += w;
  return sum;
}

double weighted_mean(const WeightedSeries& s, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += s.weight[i] * values[i];
  return sum / total_weight(s);
}

void put_residuals(LineFit& fit, const WeightedSeries& s) {
  for (int i = 0; i < s.size(); ++i) {
    fit.residual.push_back(s.y[i] - fit.at(s.x[i]));
    fit.chi_square += s.weight[i] * fit.residual.back() * fit.residual.back();
  }
}

}  // namespace

WeightedSeries WeightedSeries::part(int begin, int end) const {
  return {{x.begin() + begin, x.begin() + end},
          {y.begin() + begin, y.begin() + end},
          {weight.begin() + begin, weight.begin() + end}};
}

LineFit fit_level(const WeightedSeries& s) {
  LineFit fit;
  fit.mean_x = weighted_mean(s, s.x);
  fit.level = weighted_mean(s, s.y);
  put_residuals(fit, s);
  return fit;
}

LineFit fit_line(const WeightedSeries& s) {
  LineFit fit;
  fit.mean_x = weighted_mean(s, s.x);
  fit.level = weighted_mean(s, s.y);
  double product = 0.0;
  for (int i = 0; i < s.size(); ++i) {
    const double from_mean = s.x[i] - fit.mean_x;
    fit.spread_x += s.weight[i] * from_mean * from_mean;
    product += s.weight[i] * from_mean * (s.y[i] - fit.level);
  }
  if (fit.spread_x > 0.0) fit.slope = product / fit.spread_x;
  put_residuals(fit, s);
  return fit;
}

double parabola_chi_square(const WeightedSeries& s) {
  const LineFit line = fit_line(s);
  WeightedSeries square = s;
  for (int i = 0; i < s.size(); ++i) square.y[i] = (s.x[i] - line.mean_x) * (s.x[i] - line.mean_x);
  const LineFit own = fit_line(square);  // what the square has beyond a line
  double all = 0.0, product = 0.0;
  for (int i = 0; i < s.size(); ++i) {
    all += s.weight[i] * square.y[i] * square.y[i];
    product += s.weight[i] * own.residual[i] * line.residual[i];
  }
  if (!(own.chi_square > kOwnShare * all)) return line.chi_square;
  return std::max(line.chi_square - product * product / own.chi_square, 0.0);
}

WeightedSeries weighted(const std::vector<SeriesPoint>& points, double between) {
  WeightedSeries s;
  for (const SeriesPoint& point : points) {
    s.x.push_back(point.at);
    s.y.push_back(point.value);
    s.weight.push_back(1.0 / (point.std * point.std + between));
  }
  return s;
}

double variance_between_logs(const std::vector<SeriesPoint>& points) {
  const double freedom = static_cast<double>(points.size()) - 2.0;
  const auto scatters = [&](double between) {
    return fit_line(weighted(points, between)).chi_square > freedom;
  };
  if (!scatters(0.0)) return 0.0;
  double high = 0.0;
  for (const SeriesPoint& point : points) high = std::max(high, point.std * point.std);
  while (scatters(high)) high *= 2.0;
  double low = 0.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (scatters(middle) ? low : high) = middle;
  }
  return high;
}

double student_limit(double probability, int degrees) {
  double low = 0.0, high = 1.0;
  while (student_tail(high, degrees) > probability && high < kLargestT) high *= 2.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (student_tail(middle, degrees) > probability ? low : high) = middle;
  }
  return high;
}

}  // namespace faultline
