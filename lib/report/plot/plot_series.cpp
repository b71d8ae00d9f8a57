// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/report/plot/line_plot.hpp"

namespace faultline {
namespace {

std::vector<PlotTick> linear_ticks(const PlotAxis& axis, int count) {
  std::vector<PlotTick> ticks;
  const double step = tick_step(axis.high - axis.low, count, 0.001);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-elementary::log10(step) - 1e-9)), 0, 12);
  const auto first = static_cast<long long>(std::ceil(axis.low / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(axis.high / step + 1e-9));
  for (long long k = first; k <= last; ++k) {
    const double value = static_cast<double>(k) * step;
    ticks.push_back({value, std::abs(value) >= 1e6 ? fmt::format("{:.1e}", value)
                                                   : fmt::format("{:.{}f}", value, decimals)});
  }
  return ticks;
}

std::vector<PlotTick> log_ticks(const PlotAxis& axis, int count) {
  const int first = static_cast<int>(std::ceil(elementary::log10(axis.low) - 1e-9));
  const int last = static_cast<int>(std::floor(elementary::log10(axis.high) + 1e-9));
  const int stride = std::max(1, (last - first + count) / std::max(count, 1));
  std::vector<PlotTick> ticks;
  for (int power = first; power <= last; power += stride)
    ticks.push_back({elementary::pow(10.0, power), power >= -3 && power <= 4
                                                       ? fmt::format("{:g}", elementary::pow(10.0, power))
                                                       : fmt::format("1e{}", power)});
  return ticks;
}

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

double tick_step(double span, int count, double tolerance) {
  const double rough = span / std::max(count, 1);
  const double power = elementary::pow(10.0, std::floor(elementary::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1.0 - tolerance)) return factor * power;
  return 10.0 * power;
}

double PlotAxis::px(double value) const {
  const double share =
      logarithmic ? elementary::log(value / low) / elementary::log(high / low) : (value - low) / (high - low);
  return from_px + share * (to_px - from_px);
}

std::vector<PlotTick> ticks_of(const PlotAxis& axis, int count) {
  return axis.logarithmic ? log_ticks(axis, count) : linear_ticks(axis, count);
}

int tick_count(const PlotAxis& axis) {
  constexpr double kRoom = 66.0;  // px
  constexpr int kMost = 10;
  return std::clamp(static_cast<int>(std::abs(axis.to_px - axis.from_px) / kRoom), 2, kMost);
}

PlotAxis axis_over(const std::vector<const std::vector<double>*>& values, bool logarithmic) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::vector<double>* list : values)
    for (const double value : *list) {
      if (!std::isfinite(value) || (logarithmic && !(value > 0.0))) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  PlotAxis axis{.logarithmic = logarithmic};
  if (!(low <= high)) return logarithmic ? PlotAxis{.low = 0.1, .high = 1.0, .logarithmic = true} : axis;
  if (logarithmic) {
    axis.low = elementary::pow(10.0, std::floor(elementary::log10(low)));
    axis.high = elementary::pow(10.0, std::ceil(elementary::log10(high)));
    if (axis.low == axis.high) axis.high *= 10.0;
    return axis;
  }
  const double span = high - low;
  const double margin = span > 0.0 ? 0.05 * span : std::max(0.5 * std::abs(high), 0.5);
  axis.low = low - margin;
  axis.high = high + margin;
  return axis;
}

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
