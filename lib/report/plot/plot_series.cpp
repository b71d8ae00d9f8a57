// SPDX-License-Identifier: MIT
#include "lib/report/plot/plot_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kSampleWidth = 26.0;  // px

bool drawable(double value, const PlotAxis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0.0);
}

/// Far beyond the frame is as good as at some distance, and keeps numbers short.
double near_frame(double px) { return std::clamp(px, -5000.0, 5000.0); }

std::string path_of(const PlotSeries& series, const PlotAxis& x, const PlotAxis& y) {
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    if (!drawable(series.y[i], y) || !std::isfinite(series.x[i])) {
      pen_down = false;
      continue;
    }
    const double px = near_frame(x.px(series.x[i])), py = near_frame(y.px(series.y[i]));
    if (pen_down && series.stairs)
      path += fmt::format("H{:.1f}V{:.1f}", px, py);
    else
      path += fmt::format("{}{:.1f} {:.1f}", pen_down ? "L" : "M", px, py);
    pen_down = true;
  }
  return path;
}

/// Points without a line are dots of one path: a picture may hold thousands.
std::string dots_of(const PlotSeries& series, const PlotAxis& x, const PlotAxis& y, const PlotPen& pen) {
  std::string path;
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (drawable(series.y[i], y) && std::isfinite(series.x[i]))
      path += fmt::format("M{:.1f} {:.1f}h0", near_frame(x.px(series.x[i])), near_frame(y.px(series.y[i])));
  return fmt::format(
      "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.6\" stroke-linecap=\"round\"/>\n", path,
      pen.colour);
}

std::string bars_of(const PlotSeries& series, const PlotAxis& x, const PlotAxis& y, const PlotPen& pen) {
  std::string path;
  for (std::size_t i = 0; i < series.bar.size(); ++i)
    if (std::isfinite(series.y[i]) && std::isfinite(series.bar[i]))
      path += fmt::format("M{:.1f} {:.1f}V{:.1f}", x.px(series.x[i]),
                          near_frame(y.px(series.y[i] - series.bar[i])),
                          near_frame(y.px(series.y[i] + series.bar[i])));
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>\n", path, pen.colour);
}

std::string pen_stroke(const PlotPen& pen) {
  const std::string dashes = *pen.dashes ? fmt::format(" stroke-dasharray=\"{}\"", pen.dashes) : "";
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" stroke-linejoin=\"round\"{}",
                     pen.colour, dashes);
}

std::string curve_of(const PlotSeries& series, const PlotAxis& x, const PlotAxis& y, const PlotPen& pen) {
  if (!series.line) return dots_of(series, x, y, pen);
  return fmt::format("<path d=\"{}\" {}/>\n", path_of(series, x, y), pen_stroke(pen));
}

std::string points_of(const PlotSeries& series, const PlotAxis& x, const PlotAxis& y, const PlotPen& pen) {
  std::string svg;
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (drawable(series.y[i], y) && std::isfinite(series.x[i]))
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\" fill=\"{}\"/>",
                         near_frame(x.px(series.x[i])), near_frame(y.px(series.y[i])), pen.colour);
  return svg;
}

}  // namespace

std::string key_sample(const PlotSeries& series, const PlotPen& pen, double x, double y) {
  if (series.line)
    return fmt::format("<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" {}/>", x,
                       x + kSampleWidth, y, y, pen_stroke(pen));
  return fmt::format(
      "<path d=\"M{:.1f} {:.1f}h0\" fill=\"none\" stroke=\"{}\" stroke-width=\"5\" stroke-linecap=\"round\"/>",
      x + 0.5 * kSampleWidth, y, pen.colour);
}

std::string render_series(const PlotSeries& series, const PlotPen& pen, const PlotAxis& x,
                          const PlotAxis& y) {
  std::string svg = curve_of(series, x, y, pen);
  if (!series.bar.empty()) svg += bars_of(series, x, y, pen);
  if (series.points && series.line) svg += points_of(series, x, y, pen) + "\n";
  return svg;
}

}  // namespace faultline
