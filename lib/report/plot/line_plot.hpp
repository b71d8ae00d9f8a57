// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace faultline {

/// A scale from values to pixels.
struct PlotAxis {
  double low = 0.0, high = 1.0;  ///< values at the ends; positive when logarithmic
  double from_px = 0.0, to_px = 1.0;
  bool logarithmic = false;

  double px(double value) const;
};

struct PlotTick {
  double value = 0.0;
  std::string text;
};

/// 1, 2 or 5 times a power of ten, the smallest with at most about `count` steps over `span`; it may be
/// smaller than that takes by a share of `tolerance`.
double tick_step(double span, int count, double tolerance = 0.0);

/// Ticks at 1, 2 or 5 times a power of ten (linear) or at powers of ten (logarithmic), about `count` of them.
std::vector<PlotTick> ticks_of(const PlotAxis& axis, int count);

/// How many ticks have room for their words along a horizontal axis, at most 10.
int tick_count(const PlotAxis& axis);

/// An axis over all finite (logarithmic: positive) values, a little wider than they are; 0 to 1 (0.1 to 1)
/// when there are none.
PlotAxis axis_over(const std::vector<const std::vector<double>*>& values, bool logarithmic);

/// One curve. A NaN breaks it.
struct PlotSeries {
  std::string name;
  std::vector<double> x, y;
  bool points = false;  ///< marks at the samples besides the line
  int pen = -1;         ///< number of its pen; -1: its place in the panel
  bool line = true;     ///< false: `points` alone
  /// Half the height of an error bar at each sample; empty: none.
  std::vector<double> bar = {};
};

/// A vertical line with a word on it, such as the onset of a fault.
struct PlotMark {
  double x = 0.0;
  std::string text;
};

/// A stretch of x that is shaded, such as a gap; however short, it is seen.
struct PlotBand {
  double from = 0.0, to = 0.0;
};

struct PlotPanel {
  std::string y_label;  ///< with its unit
  std::vector<PlotSeries> series;
  bool log_y = false;  ///< values that are not positive are left out
  std::optional<std::pair<double, double>> y_range{};
};

/// Panels below each other over one x axis.
struct LinePlot {
  std::string title;
  std::string x_label;  ///< with its unit
  std::vector<PlotPanel> panels;
  std::vector<PlotMark> marks;
  int width = 760;         ///< px
  int panel_height = 170;  ///< px
  std::string id = "";     ///< of its own on a page that holds several plots
  bool captions = true;    ///< show title and legend; false where the page shows them
  std::vector<PlotBand> bands = {};
};

/// Line `i` of a panel: a colour, and dashes as in stroke-dasharray (empty: solid).
struct PlotPen {
  const char* colour;
  const char* dashes;
};
PlotPen plot_pen(std::size_t i);

/// A picture that stands alone, for screen and print: white ground, colours that the colour-blind can tell
/// apart and a line style of its own for each curve, title and description for screen readers. Curves are cut
/// at the panel's edge.
std::string render_svg(const LinePlot& plot);

/// What the series looks like, for a legend: 26 px wide from `x`, about the height `y`.
std::string key_sample(const PlotSeries& series, const PlotPen& pen, double x, double y);

/// A curve as SVG: line or dots, error bars, marks at its samples.
std::string render_series(const PlotSeries& series, const PlotPen& pen, const PlotAxis& x, const PlotAxis& y);

}  // namespace faultline
