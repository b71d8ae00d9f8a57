// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"
#include "lib/core/statistics.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/condition.hpp"
#include "lib/report/html/elements.hpp"
#include "lib/report/plot/line_plot.hpp"
#include "lib/wear/robot_wear.hpp"

namespace faultline {
namespace {

constexpr int kPictureWidth = 140, kPictureHeight = 32;  // px
constexpr double kMargin = 3.0;                          // px around the dots
constexpr std::size_t kMostDots = 200;                   // in a picture; more would cover each other

PlotAxis axis_of(const std::vector<double>& values, double from_px, double to_px) {
  PlotAxis axis = axis_over({&values}, false);
  axis.from_px = from_px;
  axis.to_px = to_px;
  return axis;
}

std::string dots(const ConditionSeries& series, const PlotAxis& x, const PlotAxis& y) {
  const std::size_t stride = series.points.size() / kMostDots + 1;
  std::string text;
  for (std::size_t i = 0; i < series.points.size(); i += stride)
    text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.6\"/>", x.px(series.points[i].at),
                        y.px(series.points[i].value));
  return text;
}

std::string change_lines(const ConditionSeries& series, const PlotAxis& x) {
  std::string text;
  for (const SeriesChange& change : series.trend.changes) {
    const auto first = static_cast<std::size_t>(change.first);
    const double at = 0.5 * (series.points[first - 1].at + series.points[first].at);
    text += fmt::format("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"0\" y2=\"{1}\" stroke=\"#d55e00\"/>",
                        x.px(at), kPictureHeight);
  }
  return text;
}

std::string trend_line(const ConditionSeries& series, const PlotAxis& x, const PlotAxis& y) {
  const SeriesTrend& trend = series.trend;
  if (!trend.not_applicable.empty()) return "";
  const double last = series.points.back().at,
               first = series.points[static_cast<std::size_t>(trend.first)].at;
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#0072b2\" stroke-width=\"1.5\"/>",
      x.px(first), y.px(trend.level - trend.slope * (last - first)), x.px(last), y.px(trend.level));
}

std::string last_words(const ConditionSeries& series) {
  const SeriesPoint& last = series.points.back();
  const double half = kNormal95 * last.std;
  return fmt::format("{} \u00b1 {}", condition_value_text(last.value, series.unit), value_text(half));
}

std::string changes_html(const RobotWear& wear, const ConditionSeries& series) {
  std::string text = escaped_markup(no_change_words(series));
  for (const SeriesChange& change : series.trend.changes)
    text += (text.empty() ? "" : "<br>") + escaped_markup(change_words(wear, series, change));
  return text;
}

std::string cell(const char* label, const std::string& html) {
  return fmt::format("<td data-label=\"{}\">{}</td>", label, html);
}

}  // namespace

std::string course_picture(const ConditionSeries& series) {
  std::vector<double> at, values;
  for (const SeriesPoint& point : series.points) {
    at.push_back(point.at);
    values.push_back(point.value);
  }
  const PlotAxis x = axis_of(at, kMargin, kPictureWidth - kMargin);
  const PlotAxis y = axis_of(values, kPictureHeight - kMargin, kMargin);
  return fmt::format(
             "<svg width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" fill=\"currentColor\" "
             "aria-hidden=\"true\">",
             kPictureWidth, kPictureHeight) +
         change_lines(series, x) + dots(series, x, y) + trend_line(series, x, y) + "</svg>";
}

std::string wear_table(const RobotWear& wear) {
  if (!wear.not_applicable.empty())
    return "<p>Not applicable: " + escaped_markup(wear.not_applicable) + ".</p>\n";
  std::string text = fmt::format(
      "<div class=\"wide\"><table{}>\n<thead><tr><th scope=\"col\">condition</th><th scope=\"col\">course</th><th "
      "scope=\"col\">logs</th><th scope=\"col\">last</th><th scope=\"col\">trend</th><th scope=\"col\">"
      "changes</th></tr></thead>\n<tbody>\n",
      html_table_class(6));
  for (const ConditionSeries& series : wear.series)
    text += "<tr>" + cell("condition", escaped_markup(printable(series.what))) +
            cell("course", course_picture(series)) + cell("logs", std::to_string(series.points.size())) +
            cell("last", escaped_markup(last_words(series))) +
            cell("trend", escaped_markup(trend_words(wear, series))) +
            cell("changes", changes_html(wear, series)) + "</tr>\n";
  return text + "</tbody></table></div>\n";
}

}  // namespace faultline
