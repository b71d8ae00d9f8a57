// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "lib/report/plot/line_plot.hpp"
#include "lib/report/plot/plot_axis.hpp"

namespace faultline {

/// Where a panel lies in the picture, px.
struct PlotFrame {
  double left, right, top, bottom;
};

/// Panel `number` of the plot as SVG: grid, legend above the frame, curves cut at it, marks, the y axis.
std::string render_panel(const LinePlot& plot, std::size_t number, const PlotFrame& frame, const PlotAxis& x);

}  // namespace faultline
