// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/report/html/elements.hpp"
#include "lib/report/html/page_figures.hpp"
#include "lib/report/plot/line_plot.hpp"

namespace faultline {
namespace {

constexpr int kPictureWidth = 420;            // px; its text is legible on a phone and on half a sheet
constexpr std::size_t kPictureSamples = 480;  // about one a pixel of paper
constexpr std::size_t kTableRows = 20;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  bool empty() const { return !(low <= high); }
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Range range_of(const FigureCurve& curve, std::size_t begin, std::size_t end) {
  Range range;
  for (std::size_t i = begin; i < end; ++i) range.add(curve.value(i));
  return range;
}

/// The curve with at most kPictureSamples samples; of each group its extremes stay, in their order.
PlotSeries thinned(const FigureCurve& curve, bool largest_only) {
  PlotSeries series{.name = curve.name, .x = {}, .y = {}, .pen = curve.pen};
  const std::size_t count = curve.count(), group = 2 * ((count + kPictureSamples - 1) / kPictureSamples);
  auto put = [&](std::size_t i) {
    series.x.push_back(curve.time_s(i));
    series.y.push_back(curve.value(i));
  };
  for (std::size_t begin = 0; begin < count; begin += group) {
    const std::size_t end = std::min(begin + group, count);
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (curve.value(i) < curve.value(low) || std::isnan(curve.value(low))) low = i;
      if (curve.value(i) > curve.value(high) || std::isnan(curve.value(high))) high = i;
    }
    if (largest_only || low == high)
      put(high);
    else
      put(std::min(low, high)), put(std::max(low, high));
  }
  return series;
}

/// That of the panel, cut at the least value of interest.
std::pair<double, double> y_range(const PageFigure& figure, const PlotPanel& panel) {
  std::vector<const std::vector<double>*> values;
  for (const PlotSeries& series : panel.series) values.push_back(&series.y);
  const PlotAxis axis = axis_over(values, panel.log_y);
  return {std::min(std::max(axis.low, figure.least_y), 0.5 * axis.high), axis.high};
}

std::string picture(const PageFigure& figure) {
  LinePlot plot;
  plot.title = figure.caption;
  plot.x_label = "time, s";
  plot.marks = figure.marks;
  plot.id = figure.id + "-";
  plot.captions = false;
  plot.width = kPictureWidth;
  plot.panel_height = 130;
  PlotPanel panel{.y_label = "", .series = {}, .log_y = figure.log_y};
  for (const FigureCurve& curve : figure.curves) panel.series.push_back(thinned(curve, figure.log_y));
  for (const FigureLimit& limit : figure.limits)
    panel.series.push_back({limit.name, {figure.from_s, figure.to_s}, {limit.value, limit.value}});
  if (std::isfinite(figure.least_y)) panel.y_range = y_range(figure, panel);
  plot.panels = {std::move(panel)};
  return render_svg(plot);
}

std::string legend(const PageFigure& figure) {
  std::string text = "<ul class=\"legend\">";
  for (const FigureCurve& curve : figure.curves)
    text +=
        legend_item(plot_pen(static_cast<std::size_t>(curve.pen)), escaped_markup(curve.name) + " <b></b>");
  std::size_t next = figure.curves.size();
  for (const FigureLimit& limit : figure.limits)
    text += legend_item(plot_pen(next++),
                        escaped_markup(fmt::format("{}: {}", limit.name, value_text(limit.value))));
  return text + "<li class=\"at\"><b></b></li></ul>";
}

std::string range_text(const Range& range, bool largest_only) {
  if (range.empty()) return "-";
  const std::string high = value_text(range.high);
  return largest_only || range.low == range.high ? high : value_text(range.low) + " to " + high;
}

std::string table(const PageFigure& figure, double sample_period_s) {
  const std::size_t count = figure.curves.front().count(), rows = std::min(count, kTableRows);
  HtmlRow head = {"from", "to"};
  for (const FigureCurve& curve : figure.curves) head.push_back(curve.name);
  std::vector<HtmlRow> cells;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t begin = r * count / rows, end = (r + 1) * count / rows;
    const FigureCurve& first = figure.curves.front();
    HtmlRow row = {time_text(first.time_s(begin), sample_period_s),
                   time_text(first.time_s(end - 1), sample_period_s)};
    for (const FigureCurve& curve : figure.curves)
      row.push_back(range_text(range_of(curve, begin, end), figure.log_y));
    cells.push_back(std::move(row));
  }
  return html_table(head, cells, figure.caption);
}

}  // namespace

std::string html_figure(const PageFigure& figure, double sample_period_s) {
  const std::string caption = escaped_markup(figure.caption);
  return fmt::format(
             "<figure id=\"{}\"><figcaption>{} <small>({})</small></figcaption>\n{}\n<div class=\"live\" "
             "tabindex=\"0\" role=\"group\" aria-roledescription=\"plot\" aria-label=\"{}. A table of it "
             "follows.\"></div>\n<div class=\"still\">",
             figure.id, caption, escaped_markup(figure.y_label), legend(figure), caption) +
         picture(figure) + "</div>\n<details><summary>Table: " + caption + "</summary>\n" +
         table(figure, sample_period_s) + "</details></figure>\n";
}

}  // namespace faultline
