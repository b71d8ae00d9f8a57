// SPDX-License-Identifier: MIT
#include "lib/report/html/comparison/comparison_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/compare/compare_runs.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/core/version.hpp"
#include "lib/diagnose/curves/curves.hpp"
#include "lib/report/html/elements.hpp"

namespace faultline {
namespace {

constexpr int kCurveBins = 700;   // of a curve
constexpr double kAround = 0.08;  // of the run, shown before and after the first divergence
constexpr int kRedPen = 1;

struct TimeSpan {
  double from = 0.0, to = 0.0;
};

/// Two extremes a bin; the samples themselves where there are few.
PlotSeries curve(const std::string& name, const SignalDifference& signal, const std::vector<double>& values,
                 const TimeSpan& span, int pen) {
  PlotSeries series{.name = name, .x = {}, .y = {}, .pen = pen};
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < signal.time.size(); ++i)
    if (signal.time[i] >= span.from && signal.time[i] <= span.to) rows.push_back(i);
  if (rows.size() <= 2 * static_cast<std::size_t>(kCurveBins)) {
    for (const std::size_t i : rows) series.x.push_back(signal.time[i]), series.y.push_back(values[i]);
    return series;
  }
  EnvelopeBuilder builder(kCurveBins);
  const double per_s = kCurveBins / (span.to - span.from);
  for (const std::size_t i : rows)
    builder.add(std::min(static_cast<int>((signal.time[i] - span.from) * per_s), kCurveBins - 1), values[i]);
  const Envelope envelope = builder.envelope();
  for (std::size_t i = 0; i < envelope.values.size(); ++i) {
    series.x.push_back(span.from + (0.5 * static_cast<double>(i) + 0.25) / per_s);
    series.y.push_back(envelope.values[i]);
  }
  return series;
}

PlotSeries level(const std::string& name, double value, const TimeSpan& span, int pen) {
  return {.name = name, .x = {span.from, span.to}, .y = {value, value}, .pen = pen};
}

NamedPlot plot_of(const SignalDifference& signal, const std::string& unit, const TimeSpan& span,
                  const std::string& suffix) {
  const std::string label = unit == "1" ? signal.quantity : signal.quantity + ", " + unit;
  LinePlot plot;
  plot.title =
      fmt::format("{} of joint {}{}", signal.quantity, signal.joint, suffix.empty() ? "" : ", close up");
  plot.title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(plot.title[0])));
  plot.x_label = "s from the start of the first run";
  PlotPanel both{label, {}}, difference{"difference", {}};
  both.series = {curve("first", signal, signal.first, span, 0),
                 curve("second", signal, signal.second, span, kRedPen)};
  difference.series = {curve("difference", signal, signal.difference, span, 3),
                       level("threshold", signal.threshold, span, 2), level("", -signal.threshold, span, 2)};
  plot.panels = {both, difference};
  if (signal.diverges_s >= span.from && signal.diverges_s <= span.to)
    plot.marks = {{signal.diverges_s, "differs"}};
  return {fmt::format("{}-{}{}", signal.quantity, signal.joint, suffix), plot};
}

/// Where the page is too narrow for the table, keys scroll it, too.
std::string scrolling(std::string table) {
  const std::string plain = "<div class=\"wide\">";
  if (table.starts_with(plain))
    table.replace(0, plain.size(),
                  "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"Differences\">");
  return table;
}

std::string difference_table(const RunComparison& comparison, const std::vector<char>& turns) {
  std::vector<HtmlRow> rows;
  for (const SignalDifference& s : comparison.signals)
    rows.push_back({s.quantity, fmt::format("{}", s.joint), unit_of(s, turns), value_text(s.rms),
                    value_text(s.largest), std::isnan(s.largest_s) ? "-" : seconds_text(s.largest_s),
                    value_text(s.threshold), percent_text(s.beyond),
                    !s.judged                  ? "not judged"
                    : std::isnan(s.diverges_s) ? "-"
                                               : seconds_text(s.diverges_s)});
  return scrolling(html_table(
      {"signal", "joint", "unit", "rms", "largest", "at", "threshold", "beyond it", "diverges at"}, rows));
}

std::string top(const RunComparison& c) {
  const char* colour = c.same() ? "healthy" : c.alignment.same_motion ? "faulty" : "inconclusive";
  return fmt::format(
      "<header>\n<h1>Two runs</h1>\n<p class=\"sub\">{} and {}, compared by faultline {}</p>\n"
      "<p class=\"verdict {}\">{}</p>\n</header>\n",
      escaped_markup(printable(c.first)), escaped_markup(printable(c.second)), program_version(), colour,
      escaped_markup(verdict_of(c)));
}

std::string alignment_part(const RunComparison& c) {
  std::vector<std::string> lines{
      c.alignment.why, fmt::format("{:.3f} s are compared", c.compared_s),
      fmt::format("threshold: {:.3g} times the noise of both signals, from their third "
                  "differences",
                  c.sigmas)};
  for (const std::string& note : c.notes) lines.push_back(printable(note));
  return "<h2>Alignment</h2>\n" + html_list(lines);
}

std::string warp_figure(const RunAlignment& alignment) {
  if (!alignment.warped()) return "";
  LinePlot plot;
  plot.title = "Time of the second run minus time of the first";
  plot.x_label = "s from the start of the first run";
  PlotSeries series{"", alignment.first_s, {}};
  for (std::size_t i = 0; i < alignment.first_s.size(); ++i)
    series.y.push_back(alignment.second_s[i] - alignment.first_s[i]);
  plot.panels = {{"s", {series}}};
  return still_figures({{"warp", plot}});
}

std::string close_up(const RunComparison& c, const std::vector<char>& turns) {
  const SignalDifference* first = c.first_divergence();
  if (!first) return "";
  const double around = kAround * c.compared_s;
  const TimeSpan span{std::max(first->diverges_s - around, 0.0),
                      std::min(first->diverges_s + around, c.first_length_s)};
  std::vector<NamedPlot> plots;
  for (const SignalDifference& signal : c.signals)
    if (signal.joint == first->joint && !std::isnan(signal.rms))
      plots.push_back(plot_of(signal, unit_of(signal, turns), span, "-close"));
  return fmt::format("<h2>Around {}</h2>\n", seconds_text(first->diverges_s)) + still_figures(plots);
}

}  // namespace

std::string render_comparison_html(const RunComparison& c, const std::vector<char>& turns) {
  std::string text = html_head("Two runs compared", false) + "<body>\n" + top(c) + "<main>\n";
  text += alignment_part(c) + warp_figure(c.alignment) + "<h2>Differences</h2>\n" +
          difference_table(c, turns) + close_up(c, turns);
  const TimeSpan whole{0.0, c.first_length_s};
  for (const char* quantity : {"residual", "position", "velocity", "torque"}) {
    std::vector<NamedPlot> plots;
    for (const SignalDifference& signal : c.signals)
      if (signal.quantity == quantity && !std::isnan(signal.rms))
        plots.push_back(plot_of(signal, unit_of(signal, turns), whole, ""));
    if (!plots.empty()) text += fmt::format("<h2>By {}</h2>\n", quantity) + still_figures(plots);
  }
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace faultline
