// SPDX-License-Identifier: MIT
#include "lib/report/plot/line_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "lib/core/text.hpp"

namespace faultline {
namespace {

/// Colours after Okabe and Ito (2008), distinct for colour-blind readers, each with its own dashes.
constexpr std::array<PlotPen, 6> kPens = {{{"#0072b2", ""},
                                           {"#d55e00", "7 3"},
                                           {"#009e73", "2 2.5"},
                                           {"#000000", "9 3 2 3"},
                                           {"#cc79a7", "12 4"},
                                           {"#8a6d00", "4 2 1 2"}}};

constexpr double kLeft = 74.0, kRight = 14.0, kHeading = 32.0, kTop = 8.0, kBottom = 46.0, kLegend = 20.0,
                 kNoLegend = 6.0, kGap = 14.0;

constexpr double kNarrowestBand = 1.5;  // px

double legend_height(const LinePlot& plot) { return plot.captions ? kLegend : kNoLegend; }

PlotAxis shared_x(const LinePlot& plot) {
  std::vector<const std::vector<double>*> values;
  for (const PlotPanel& panel : plot.panels)
    for (const PlotSeries& series : panel.series) values.push_back(&series.x);
  PlotAxis x = axis_over(values, false);
  const double margin = (x.high - x.low) / 22.0;  // curves in time fill the frame
  x.low += margin;
  x.high -= margin;
  x.from_px = kLeft;
  x.to_px = plot.width - kRight;
  return x;
}

/// Font size, px, at which the title fits above the panels.
double title_size(const LinePlot& plot) {
  constexpr double kUsual = 14.0, kWidthOfLetter = 0.58;  // of the font size, bold
  const double room = plot.width - kLeft - kRight;
  return std::min(kUsual, room / (kWidthOfLetter * std::max(static_cast<double>(plot.title.size()), 1.0)));
}

std::string description(const LinePlot& plot) {
  std::string text;
  for (const PlotPanel& panel : plot.panels) {
    text += panel.y_label + " over " + plot.x_label + ":";
    for (const PlotSeries& series : panel.series) text += " " + series.name + ";";
    text += " ";
  }
  for (const PlotMark& mark : plot.marks) text += fmt::format("{} at {:g}. ", mark.text, mark.x);
  return text;
}

/// Where a panel lies in the picture, px.
struct PlotFrame {
  double left, right, top, bottom;
};

/// Ends of the error bars, so that the axis holds them.
std::vector<double> bar_ends(const PlotPanel& panel) {
  std::vector<double> ends;
  for (const PlotSeries& series : panel.series)
    for (std::size_t i = 0; i < series.bar.size(); ++i) {
      ends.push_back(series.y[i] - series.bar[i]);
      ends.push_back(series.y[i] + series.bar[i]);
    }
  return ends;
}

std::string grid(const PlotFrame& f, const PlotAxis& x, const PlotAxis& y) {
  std::string svg;
  for (const PlotTick& tick : ticks_of(y, 5))
    svg += fmt::format(
        "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#dddddd\"/><text x=\"{3}\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
        f.left, f.right, y.px(tick.value), f.left - 6, y.px(tick.value) + 4, tick.text);
  for (const PlotTick& tick : ticks_of(x, tick_count(x)))
    svg += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#eeeeee\"/>\n",
                       x.px(tick.value), f.top, f.bottom);
  return svg;
}

std::string bands(const LinePlot& plot, const PlotFrame& f, const PlotAxis& x) {
  std::string svg;
  for (const PlotBand& band : plot.bands)
    svg += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\" fill=\"#b3261e\" "
        "fill-opacity=\"0.22\"/>\n",
        x.px(band.from), f.top, std::max(x.px(band.to) - x.px(band.from), kNarrowestBand), f.bottom - f.top);
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
    svg += key_sample(panel.series[i], pen_of(panel, i), at, f.top - 8.0) +
           fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", at + 31.0, f.top - 4.0,
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

/// Panel `number` of the plot as SVG: grid, legend above the frame, curves cut at it, marks, the y axis.
std::string render_panel(const LinePlot& plot, std::size_t number, const PlotFrame& f, const PlotAxis& x) {
  const PlotPanel& panel = plot.panels[number];
  std::vector<const std::vector<double>*> values;
  for (const PlotSeries& series : panel.series) values.push_back(&series.y);
  const std::vector<double> ends = bar_ends(panel);
  values.push_back(&ends);
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
  svg += bands(plot, f, x);
  for (std::size_t i = 0; i < panel.series.size(); ++i)
    svg += render_series(panel.series[i], pen_of(panel, i), x, y);
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

}  // namespace

PlotPen plot_pen(std::size_t i) { return kPens[i % kPens.size()]; }

std::string render_svg(const LinePlot& plot) {
  const double step = plot.panel_height + legend_height(plot) + kGap;
  const double top = kTop + (plot.captions ? kHeading : 0.0);
  const double height = top + step * static_cast<double>(plot.panels.size()) - kGap + kBottom;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1:.0f}\" width=\"{0}\" "
      "height=\"{1:.0f}\" "
      "role=\"img\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" "
      "fill=\"#1b1f24\">\n<title>{2}"
      "</title>\n<desc>{3}</desc>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      plot.width, height, escaped_markup(plot.title), escaped_markup(description(plot)));
  if (plot.captions)
    svg += fmt::format("<text x=\"{}\" y=\"20\" font-size=\"{:.1f}\" font-weight=\"bold\">{}</text>\n", kLeft,
                       title_size(plot), escaped_markup(plot.title));
  const PlotAxis x = shared_x(plot);
  PlotFrame frame{kLeft, plot.width - kRight, top + legend_height(plot), 0.0};
  for (std::size_t i = 0; i < plot.panels.size(); ++i, frame.top += step) {
    frame.bottom = frame.top + plot.panel_height;
    svg += render_panel(plot, i, frame, x);
  }
  const double foot = frame.top - step + plot.panel_height;
  for (const PlotTick& tick : ticks_of(x, tick_count(x)))
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", x.px(tick.value),
                       foot + 17.0, tick.text);
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                     0.5 * (kLeft + plot.width - kRight), foot + 36.0, escaped_markup(plot.x_label));
  return svg + "</svg>\n";
}

}  // namespace faultline
