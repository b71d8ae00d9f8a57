// SPDX-License-Identifier: MIT
#include "lib/report/plot/line_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lib/core/markup.hpp"
#include "lib/report/plot/plot_axis.hpp"
#include "lib/report/plot/plot_panel.hpp"

namespace faultline {
namespace {

/// Colours after Okabe and Ito (2008), told apart by colour-blind readers, each with its own dashes.
constexpr std::array<PlotPen, 6> kPens = {{{"#0072b2", ""},
                                           {"#d55e00", "7 3"},
                                           {"#009e73", "2 2.5"},
                                           {"#000000", "9 3 2 3"},
                                           {"#cc79a7", "12 4"},
                                           {"#8a6d00", "4 2 1 2"}}};

constexpr double kLeft = 74.0, kRight = 14.0, kHeading = 32.0, kTop = 8.0, kBottom = 46.0, kLegend = 20.0,
                 kNoLegend = 6.0, kGap = 14.0;

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
