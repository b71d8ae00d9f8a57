// SPDX-License-Identifier: MIT
#include "lib/report/html/html_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "lib/core/markup.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/report/condition_table.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/html/assets.hpp"
#include "lib/report/html/elements.hpp"
#include "lib/report/html/finding.hpp"
#include "lib/report/html/head.hpp"
#include "lib/report/html/page_figures.hpp"
#include "lib/report/plot/plot_axis.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

// Along the run in per cent, the rest in px.
constexpr double kWhole = 100.0;
constexpr double kNumberRoom = 2.4;  // that a number takes on a desk, and on a phone
constexpr double kNumberRoomNarrow = 9.0;
constexpr double kEasyTarget = 9.0;  // narrower faults get more to click at
constexpr double kNearEnd = 92.0;
constexpr int kLane = 30, kTop = 6, kFoot = 24;

/// Lane 0 is for faults of no joint.
class Picture {
 public:
  explicit Picture(const Diagnosis& d) : d_(d) {
    axis_ = {.low = d.log.start_s - zero_s_, .high = d.log.end_s - zero_s_, .from_px = 0.0, .to_px = kWhole};
    for (const FaultFinding& f : d.faults) {
      joints_ = std::max(joints_, f.label.joint);
      first_lane_ = f.label.joint > 0 ? first_lane_ : 0;
    }
  }

  std::string text() const {
    std::string html = "<div class=\"timeline\">\n<div class=\"names\">";
    for (int lane = first_lane_; lane <= joints_; ++lane)
      html += lane > 0 ? fmt::format("<span>joint {}</span>", lane) : "<span>robot</span>";
    html += fmt::format("</div>\n<svg height=\"{}\" role=\"group\" aria-label=\"Timeline of the run: {}\">\n",
                        foot() + kFoot, counted(std::ssize(d_.faults), "fault"));
    for (int lane = first_lane_; lane <= joints_; ++lane)
      html += fmt::format("<rect class=\"lane\" y=\"{}\" width=\"100%\" height=\"6\"/>\n", lane_y(lane) + 8);
    for (std::size_t i = 0; i < d_.faults.size(); ++i)
      if (std::isfinite(d_.faults[i].onset_s)) html += fault_text(d_.faults[i], room_after(i));
    return html + ticks() + "</svg>\n</div>\n";
  }

 private:
  int lane_y(int lane) const { return kTop + kLane * (lane - first_lane_); }
  int foot() const { return lane_y(joints_ + 1); }
  double place(double time_s) const { return std::clamp(axis_.px(time_s - zero_s_), 0.0, kWhole); }

  std::string described(const FaultFinding& f) const {
    const double period = d_.log.sample_period_s;
    return escaped_markup(fmt::format("Fault {}: {}; onset {}, alarm {}, end {}, confidence {}", f.id,
                                      plain_words(f.label), onset_words(f, period),
                                      clock_words(f, f.alarm_s, period), clock_words(f, f.end_s, period),
                                      percent_text(f.confidence)));
  }

  /// Between a fault's onset and the next one on its lane.
  double room_after(std::size_t i) const {
    for (std::size_t k = i + 1; k < d_.faults.size(); ++k)
      if (d_.faults[k].label.joint == d_.faults[i].label.joint && std::isfinite(d_.faults[k].onset_s))
        return place(d_.faults[k].onset_s) - place(d_.faults[i].onset_s);
    return kWhole;
  }

  static std::string bar(const char* name, double from, double to, int y, int height) {
    return fmt::format("<rect class=\"{}\" x=\"{:.2f}%\" y=\"{}\" width=\"{:.2f}%\" height=\"{}\"/>", name,
                       from, y, to - from, height);
  }

  std::string fault_text(const FaultFinding& f, double room) const {
    const int y = lane_y(std::max(f.label.joint, 0));
    const double onset = place(f.onset_s), alarm = std::isfinite(f.alarm_s) ? place(f.alarm_s) : onset;
    const double end = std::max({std::isfinite(f.end_s) ? place(f.end_s) : kWhole, onset, alarm});
    std::string svg = fmt::format("<a {0} aria-label=\"{1}\">", html_fault_link(f, zero_s_), described(f));
    svg += bar("hit", onset, end, y - 3, kLane - 2);
    if (end - onset < kEasyTarget)
      svg += fmt::format(
          "<rect class=\"hit\" x=\"{:.2f}%\" y=\"{}\" width=\"28\" height=\"28\" transform=\"translate(-14)\"/>",
          0.5 * (onset + end), y - 3);
    svg += bar("before", onset, alarm, y + 5, 12) + bar("fault", alarm, end, y, 22);
    svg += fmt::format("<rect class=\"alarm\" x=\"{:.2f}%\" y=\"{}\" width=\"2.5\" height=\"26\"/>", alarm,
                       y - 2);
    if (room < kNumberRoom) return svg + "</a>\n";
    const bool after = onset < kNearEnd;
    return svg + fmt::format("<text class=\"number{}\" x=\"{:.2f}%\" dx=\"{}\" y=\"{}\"{}>{}</text></a>\n",
                             room < kNumberRoomNarrow ? " tight" : "", after ? alarm : onset, after ? 6 : -5,
                             y + 16, after ? "" : " text-anchor=\"end\"", f.id);
  }

  /// Every second one is left out on a phone.
  std::string ticks() const {
    std::string svg;
    bool minor = false;
    for (const PlotTick& tick : ticks_of(axis_, 10)) {
      const double x = axis_.px(tick.value);
      svg += fmt::format(
          "<line x1=\"{0:.2f}%\" x2=\"{0:.2f}%\" y1=\"{1}\" y2=\"{2}\"/><text class=\"tick{6}\" "
          "x=\"{0:.2f}%\" y=\"{3}\" text-anchor=\"{4}\">{5} s</text>\n",
          x, foot() - 4, foot() + 2, foot() + 18,
          x < 2.0    ? "start"
          : x > 97.0 ? "end"
                     : "middle",
          tick.text, minor ? " minor" : "");
      minor = !minor;
    }
    return svg;
  }

  const Diagnosis& d_;
  double zero_s_ = time_zero(d_.log.start_s);
  PlotAxis axis_;
  int joints_ = d_.log.joints;
  int first_lane_ = 1;
};

/// The run from left to right, a lane a joint, as an SVG whose text keeps its size; each fault is a link to
/// "#fault-ID" that names its kind and times. Empty when the log has no span of time.
std::string html_timeline(const Diagnosis& d) {
  const double span_s = d.log.end_s - d.log.start_s;
  return std::isfinite(span_s) && span_s > 0.0 ? Picture(d).text() : "";
}

std::string rate_text(const LogFacts& log) {
  if (!(log.sample_period_s > 0.0)) return "";
  return fmt::format(", a sample every {} s", value_text(log.sample_period_s));
}

std::string timeline_key(const Diagnosis& d) {
  std::string text;
  if (!d.faults.empty()) text = "Low: onset to alarm; high: alarm to end. Choose a fault to see it. ";
  if (const double zero_s = time_zero(d.log.start_s); zero_s != 0.0)
    text += fmt::format("Axes of time count from {:.0f} s.", zero_s);
  return text.empty() ? "" : "<p class=\"key\">" + text + "</p>\n";
}

std::string top(const Diagnosis& d) {
  const std::string name = printable(d.log.path);
  std::string text = fmt::format(
      "<header>\n<h1{}>{}</h1>\n<p class=\"sub\">{} to {}, {} rows{}; model {}, faultline {}</p>\n<p "
      "class=\"verdict {}\">{}</p>\n",
      name.size() > 300 ? " class=\"long\" tabindex=\"0\"" : "", escaped_markup(name),
      time_text(d.log.start_s, d.log.sample_period_s), time_text(d.log.end_s, d.log.sample_period_s),
      d.log.rows_read, rate_text(d.log), escaped_markup(printable(d.model.name).substr(0, 200)),
      escaped_markup(d.program_version), to_string(d.verdict), escaped_markup(verdict_sentence(d)));
  for (const std::string& note : d.model.notes)
    text += fmt::format("<p class=\"sub\">Note: {}</p>\n", escaped_markup(printable(note)));
  if (d.verdict == Verdict::healthy || !d.faults.empty()) text += html_timeline(d);
  text += timeline_key(d);
  return text + html_fault_table(d) + "</header>\n";
}

std::string residual_table(const Diagnosis& d) {
  std::vector<HtmlRow> rows;
  for (const JointResidual& r : d.residuals)
    rows.push_back({std::to_string(r.joint), value_text(r.velocity_rms), value_text(r.velocity_peak),
                    time_text(r.velocity_peak_s, d.log.sample_period_s), value_text(r.position_rms)});
  return html_table(
      FactTable{"Residuals against the regenerated fault-free motion (1 = as in the healthy logs)",
                {"joint", "velocity rms", "largest", "at", "position rms"},
                rows});
}

std::string log_quality(const Diagnosis& d) {
  std::vector<HtmlRow> rows;
  for (const Issue& issue : d.log.issues.all())
    rows.push_back({to_string(issue.severity), issue.code, issue.channel,
                    issue.first_row > 0 ? std::to_string(issue.first_row) : "", std::to_string(issue.count),
                    std::to_string(issue.rows_dropped), issue.message});
  const std::string table = html_table(
      {"severity", "code", "channel", "first in row", "times", "rows left out", "what"}, rows, "Issues");
  return "<h2 id=\"log\">Log quality</h2>\n" +
         html_table({},
                    {{"rows read", std::to_string(d.log.rows_read)},
                     {"rows used", std::to_string(d.log.rows_used)},
                     {"format", d.log.format},
                     {"sample period", value_text(d.log.sample_period_s) + " s"}},
                    "The log") +
         (table.empty() ? "<p>The log has no issues.</p>\n" : table) +
         html_part("What this log and model cannot show", html_list(d.cannot_see));
}

/// Those without a title have that of their section.
std::string tables(const std::vector<FactTable>& list, const char* section) {
  std::string text;
  for (const FactTable& table : list)
    text += table.title.empty() ? html_table(table.head, table.rows, section) : html_table(table);
  return text;
}

std::string provenance(const Diagnosis& d, const ReportDetails& details) {
  return "<h2 id=\"provenance\">Provenance</h2>\n<p>A diagnosis of the log with this hash and with these "
         "files and options gives the same report.</p>\n" +
         html_table({},
                    {{"log", printable(d.log.path)},
                     {"log SHA-256", d.log.sha256},
                     {"model", d.model.name},
                     {"model SHA-256", d.model.sha256},
                     {"case base SHA-256 (of its content)", d.model.cases_sha256},
                     {"program", "faultline " + d.program_version}},
                    "Provenance") +
         tables(details.provenance, "Provenance");
}

std::string scripts(const std::string& plot_data) {
  return fmt::format(
      "<script type=\"application/json\" id=\"plot-data\">{}</script>\n<script>{}</script>\n<script>{}"
      "</script>\n",
      plot_data, dygraphs_script(), page_script());
}

/// The times that plots show, counted from `zero_s`.
RunCurves counted_from(double zero_s, RunCurves curves) {
  auto shift = [&](CurveWindow& window) {
    window.start_s -= zero_s;
    window.end_s -= zero_s;
  };
  shift(curves.whole);
  for (CurveWindow& window : curves.details) shift(window);
  return curves;
}

std::vector<FaultFinding> counted_from(double zero_s, std::vector<FaultFinding> faults) {
  for (FaultFinding& f : faults) {
    for (double* time : {&f.onset_s, &f.alarm_s, &f.end_s}) *time -= zero_s;
    for (double& time : f.trace.time) time -= zero_s;
  }
  return faults;
}

}  // namespace

std::string render_html(const Diagnosis& d, const ReportDetails& details) {
  const double zero_s = time_zero(d.log.start_s), period = d.log.sample_period_s;
  const RunCurves curves = counted_from(zero_s, details.curves);
  const std::vector<FaultFinding> faults = counted_from(zero_s, d.faults);
  const std::vector<PageFigure> whole = run_figures(faults, curves);
  std::string text =
      html_head(printable(d.log.path).substr(0, 200), !whole.empty()) + "<body>\n" + top(d) + "<main>\n";
  std::vector<PageFigure> all = whole;
  for (std::size_t i = 0; i < d.faults.size() && i < std::size_t{kFullFindings}; ++i) {
    const std::vector<PageFigure> figures = fault_figures(faults[i], curves);
    if (i > 0 && i == curves.details.size())
      text += "<p class=\"sub\">The faults from here on have no plots of their own; see the whole run.</p>\n";
    text += html_finding(d.faults[i], figures, period);
    all.insert(all.end(), figures.begin(), figures.end());
  }
  if (!d.small_changes.empty())
    text += fmt::format("<h2 id=\"small\">{}</h2>\n", kSmallChangesTitle) + html_list(small_change_lines(d));
  const FactTable condition = condition_table(d);
  if (!condition.rows.empty())
    text += fmt::format("<h2 id=\"condition\">{}</h2>\n", escaped_markup(condition.title)) +
            html_table(condition.head, condition.rows, condition.title);
  text += "<h2 id=\"run\">The whole run</h2>\n" + html_plots(whole, 0, period) + residual_table(d);
  text += log_quality(d);
  if (!details.model.empty())
    text += "<h2 id=\"model\">The model</h2>\n" + tables(details.model, "The model");
  text += provenance(d, details) + "</main>\n";
  if (!whole.empty()) text += scripts(html_plot_data(faults, curves, all));
  return text + "</body>\n</html>\n";
}

}  // namespace faultline
