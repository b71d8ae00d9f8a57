// SPDX-License-Identifier: MIT
#include "lib/report/html/identification/trend_figures.hpp"

#include <fmt/format.h>

#include <cmath>

#include "lib/report/html/identification/torque_figures.hpp"

namespace faultline {
namespace {

NamedPlot trend_figure(const ParameterTrend& trend, std::size_t logs) {
  const double first = 0.5, last = static_cast<double>(logs) + 0.5;
  PlotSeries values{.name = "each log alone", .x = {}, .y = {}, .points = true};
  for (const LogValue& v : trend.by_log) {
    values.x.push_back(v.log + 1.0);
    values.y.push_back(v.value);
    values.bar.push_back(0.5 * (v.ci95[1] - v.ci95[0]));
  }
  LinePlot plot = figure_plot(fmt::format("{} from log to log", trend.name), "log");
  plot.panels = {{.y_label = trend.unit.empty() ? trend.name : fmt::format("{}, {}", trend.name, trend.unit),
                  .series = {values, {.name = "mean", .x = {first, last}, .y = {trend.mean, trend.mean}}}}};
  return {"trend-" + trend.name, plot};
}

}  // namespace

std::vector<NamedPlot> trend_figures(const Identification& id) {
  std::vector<NamedPlot> plots;
  for (const ParameterTrend& trend : id.trends)
    if (trend.flagged()) plots.push_back(trend_figure(trend, id.logs.size()));
  return plots;
}

}  // namespace faultline
