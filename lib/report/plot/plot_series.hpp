// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/report/plot/line_plot.hpp"
#include "lib/report/plot/plot_axis.hpp"

namespace faultline {

/// What the series looks like, for a legend: 26 px wide from `x`, about the height `y`.
std::string key_sample(const PlotSeries& series, const PlotPen& pen, double x, double y);

/// A curve as SVG: line or dots, error bars, marks at its samples.
std::string render_series(const PlotSeries& series, const PlotPen& pen, const PlotAxis& x, const PlotAxis& y);

}  // namespace faultline
