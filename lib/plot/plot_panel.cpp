// SPDX-License-Identifier: MIT
#include "lib/plot/plot_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "lib/core/markup.hpp"

namespace faultline {
namespace {

std::string stroke(const PlotPen& pen) {
  const std::string dashes = *pen.dashes ? fmt::format(" stroke-dasharray=\"{}\"", pen.dashes) : "";
  return fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" stroke-linejoin=\"round\"{}",
                     pen.colour, dashes);
}

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

std::string points_of(const PlotSeries& series, const PlotAxis& x, const PlotAxis& y, const PlotPen& pen) {
  std::string svg;
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (drawable(series.y[i], y) && std::isfinite(series.x[i]))
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.2\" fill=\"{}\"/>",
                         near_frame(x.px(series.x[i])), near_frame(y.px(series.y[i])), pen.colour);
  return svg;
}

std::string grid(const PlotFrame& f, const PlotAxis& x, const PlotAxis& y) {
  std::string svg;
  for (const PlotTick& tick : ticks_of(y, 5))
    svg += fmt::format(
        "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#dddddd\"/><text x=\"{3}\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
        f.left, f.right, y.px(tick.value), f.left - 6, y.px(tick.value) + 4, tick.text);
  for (const PlotTick& tick : ticks_of(x, 10))
    svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#eeeeee\"/>\n",
                       x.px(tick.value), f.top, f.bottom);
  return svg;
}

PlotPen pen_of(const PlotPanel& panel, std::size_t i) {
  const int pen = panel.series[i].pen;
  return plot_pen(pen < 0 ? i : static_cast<std::size_t>(pen));
}

std::string legend(const PlotPanel& panel, const PlotFrame& f) {
  std::string svg;
  double at = f.left + 2.0;
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const std::string& name = panel.series[i].name;
    if (name.empty()) continue;
    svg += fmt::format(
        "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" {}/><text x=\"{:.1f}\" y=\"{:.1f}\">{}"
        "</text>\n",
        at, at + 26.0, f.top - 8.0, f.top - 8.0, stroke(pen_of(panel, i)), at + 31.0, f.top - 4.0,
        escaped_markup(name));
    at += 46.0 + 6.6 * static_cast<double>(name.size());
  }
  return svg;
}

/// The words at marks: on the other side when they would reach into the next mark, or below without room
/// there.
class MarkWords {
 public:
  MarkWords(const PlotFrame& frame, const PlotAxis& x) : frame_(frame), x_(x) {}

  std::string at(const PlotMark& mark, double next_px) {
    const double px = x_.px(mark.x), width = 8.0 + 6.6 * static_cast<double>(mark.text.size());
    const bool left = next_px - px < width && px - frame_.left > width;
    const bool below = !left && px < taken_px_;
    if (!left && !below) taken_px_ = px + width;
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#b3261e\"{}>{}</text>\n",
                       px + (left ? -5.0 : 5.0), frame_.top + (below ? 28.0 : 14.0),
                       left ? " text-anchor=\"end\"" : "", escaped_markup(mark.text));
  }

 private:
  const PlotFrame& frame_;
  const PlotAxis& x_;
  double taken_px_ = -1e9;
};

std::string marks(const LinePlot& plot, const PlotFrame& f, const PlotAxis& x, bool with_text) {
  std::string svg;
  MarkWords words(f, x);
  for (std::size_t i = 0; i < plot.marks.size(); ++i) {
    const PlotMark& mark = plot.marks[i];
    if (!(mark.x >= x.low && mark.x <= x.high)) continue;
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#b3261e\" stroke-width=\"1.4\" "
        "stroke-dasharray=\"5 3\"/>\n",
        x.px(mark.x), f.top, f.bottom);
    const bool last = i + 1 == plot.marks.size() || plot.marks[i + 1].x > x.high;
    if (with_text) svg += words.at(mark, last ? f.right : x.px(plot.marks[i + 1].x));
  }
  return svg;
}

/// Panels that show the same curves as the one above them need no legend of their own.
bool needs_legend(const LinePlot& plot, std::size_t number) {
  if (number == 0) return true;
  const auto same = [](const PlotSeries& a, const PlotSeries& b) { return a.name == b.name; };
  const auto &above = plot.panels[number - 1].series, &here = plot.panels[number].series;
  return !std::equal(above.begin(), above.end(), here.begin(), here.end(), same);
}

}  // namespace

std::string render_panel(const LinePlot& plot, std::size_t number, const PlotFrame& f, const PlotAxis& x) {
  const PlotPanel& panel = plot.panels[number];
  std::vector<const std::vector<double>*> values;
  for (const PlotSeries& series : panel.series) values.push_back(&series.y);
  PlotAxis y = axis_over(values, panel.log_y);
  if (panel.y_range) std::tie(y.low, y.high) = *panel.y_range;
  y.from_px = f.bottom;
  y.to_px = f.top;
  std::string svg = grid(f, x, y);
  if (plot.captions && needs_legend(plot, number)) svg += legend(panel, f);
  svg += fmt::format(
      "<clipPath id=\"{5}panel{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/>"
      "</clipPath>\n<g clip-path=\"url(#{5}panel{0})\">\n",
      number, f.left, f.top, f.right - f.left, f.bottom - f.top, plot.id);
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    svg += fmt::format("<path d=\"{}\" {}/>\n", path_of(panel.series[i], x, y), stroke(pen_of(panel, i)));
    if (panel.series[i].points) svg += points_of(panel.series[i], x, y, pen_of(panel, i)) + "\n";
  }
  svg += "</g>\n" + marks(plot, f, x, number == 0);
  svg +=
      fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#666666\"/>\n",
                  f.left, f.top, f.right - f.left, f.bottom - f.top);
  const double middle = 0.5 * (f.top + f.bottom);
  return svg + fmt::format(
                   "<text x=\"14\" y=\"{0:.1f}\" text-anchor=\"middle\" transform=\"rotate(-90 14 {0:.1f})\">"
                   "{1}</text>\n",
                   middle, escaped_markup(panel.y_label));
}

}  // namespace faultline
