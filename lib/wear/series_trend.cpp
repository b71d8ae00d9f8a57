// SPDX-License-Identifier: MIT
#include "lib/wear/series_trend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

/// Parameters of a line.
constexpr int kLineParameters = 2;

void fit_trend(SeriesTrend& trend, const std::vector<SeriesPoint>& points, double false_alarms) {
  const double between = variance_between_logs(points);
  const WeightedSeries s = weighted(points, between);
  const LineFit line = fit_line(s);
  if (!(line.spread_x > 0.0)) {
    trend.not_applicable = "all logs have the same date";
    return;
  }
  std::vector<double> residuals;
  for (int i = 0; i < s.size(); ++i) residuals.push_back(line.residual[i] * std::sqrt(s.weight[i]));
  const double factor = correlation_factor(residuals, kLineParameters);
  const int degrees = std::max(static_cast<int>(s.size() / factor) - kLineParameters, 1);
  const double std = std::sqrt(factor / line.spread_x);
  const double half = student_limit(0.05, degrees) * std;
  trend.slope = line.slope;
  trend.slope_ci95 = {line.slope - half, line.slope + half};
  trend.level = line.at(points.back().at);
  trend.between_std = std::sqrt(between);
  trend.p = student_tail(line.slope / std, degrees);
  trend.is_trend = trend.p < false_alarms;
}

}  // namespace

SeriesTrend series_trend(const std::vector<SeriesPoint>& points, double false_alarms) {
  LimitedSeries limited = without_outliers(points);
  SeriesTrend trend;
  trend.outliers = std::move(limited.outliers);
  trend.changes = change_points(limited.points, false_alarms);
  trend.first = trend.changes.empty() ? 0 : trend.changes.back().first;
  const std::vector<SeriesPoint> since(limited.points.begin() + trend.first, limited.points.end());
  if (static_cast<int>(since.size()) >= kLogsForTrend) {
    fit_trend(trend, since, false_alarms);
    return trend;
  }
  const char* which = !trend.changes.empty() ? "since the last change"
                      : since.size() == 1    ? "determines it"
                                             : "determine it";
  trend.not_applicable = fmt::format(
      "{} {}, {} are needed", counted(static_cast<long long>(since.size()), "log"), which, kLogsForTrend);
  return trend;
}

}  // namespace faultline
