// SPDX-License-Identifier: MIT
#include "lib/report/html/html_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lib/core/error.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/curves/run_curves.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/html/elements.hpp"
#include "lib/report/html/page_figures.hpp"
#include "lib/report/model_facts.hpp"
#include "lib/report/stop_report.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLongestTitle = 300;  // bytes of the title of the page

FactTable option_table(const Model& model, const DiagnoseOptions& options) {
  FactTable table{"Options", {}, {}};
  table.rows.push_back({"--classify", to_string(options.mode)});
  if (options.mode == ClassifyMode::samples) {
    table.rows.push_back({"--criterion", to_string(options.criterion)});
    table.rows.push_back({"--g", options.g > 0 ? std::to_string(options.g) : "0 (as tuned by learn)"});
  }
  table.rows.push_back({"least alarm threshold", fact_text(least_limit(model.explain.limits), "nats")});
  return table;
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
  return html_table(
      FactTable{"Residuals against the regenerated fault-free motion (1 = as in the healthy logs)",
                {"joint", "velocity rms", "largest", "at", "position rms"},
                residual_rows(d)});
}

/// The answer about the stop that was asked about; empty if none was.
std::string stop_part(const Diagnosis& d) {
  if (!d.stop) return "";
  const StopAnswer& stop = *d.stop;
  const double period = d.log.sample_period_s;
  std::string text =
      fmt::format("<h2 id=\"stop\">{}</h2>\n", escaped_markup(printable(stop_title(stop, period))));
  text += html_list(stop.summary) + html_table(stop_signal_table(stop, period));
  if (stop.short_log) text += html_part("How much so short a log shows", html_list(stop.short_log->notes));
  return text + html_table(stop_reach_table(stop)) +
         html_part("Not looked at", html_list(stop.not_looked_at));
}

/// The moments of the stop and of its first sign, counted from `zero_s`.
std::vector<PlotMark> stop_marks(const Diagnosis& d, double zero_s) {
  if (!d.stop) return {};
  std::vector<PlotMark> marks = {{d.stop->question.time_s - zero_s, "stop"}};
  if (d.stop->first_sign) marks.push_back({d.stop->first_sign->time_s - zero_s, "first sign"});
  return marks;
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

/// Words of the page that not every reader knows.
constexpr std::array<std::array<const char*, 2>, 8> kWords{{
    {"alarm", "earliest row at which what was seen so far would have raised the finding"},
    {"confidence", "how often findings said with it are right, calibrated on simulated runs"},
    {"evidence", "how much better the log is explained with the fault than without, in nats"},
    {"MLP, RBFN",
     "the two networks that classify the evidence: multi-layer perceptron, radial basis function network"},
    {"nat", "unit of evidence: 1 nat is 2.7 times as likely, 18 nats some 66 million times"},
    {"onset", "estimated begin of the fault"},
    {"residual", "measured minus regenerated motion, in units of what is usual when healthy"},
    {"similar case", "a remembered episode that resembles this one, with what was done about it"},
}};

std::string words_part() {
  std::string text = "<h2 id=\"words\">Words</h2>\n<dl>\n";
  for (const auto& [word, meaning] : kWords) text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", word, meaning);
  return text + "</dl>\n";
}

/// Links to the parts of the page.
std::string contents(const Diagnosis& d, bool has_condition, bool has_model) {
  std::vector<std::pair<std::string, std::string>> links;
  if (d.stop) links.emplace_back("stop", "The stop");
  for (std::size_t i = 0; i < std::min<std::size_t>(d.faults.size(), kFullFindings); ++i)
    links.emplace_back(fmt::format("fault-{}", d.faults[i].id), fmt::format("Fault {}", d.faults[i].id));
  if (!d.small_changes.empty()) links.emplace_back("small", "Small changes");
  if (has_condition) links.emplace_back("condition", "Condition");
  links.emplace_back("run", "The whole run");
  links.emplace_back("log", "Log quality");
  if (has_model) links.emplace_back("model", "The model");
  links.emplace_back("provenance", "Provenance");
  links.emplace_back("words", "Words");
  std::string text = "<nav class=\"contents\" aria-label=\"Contents\">\n";
  for (const auto& [place, words] : links) text += fmt::format("<a href=\"#{}\">{}</a>\n", place, words);
  return text + "</nav>\n";
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

template <std::string (*render)(const Diagnosis&)>
std::string from_diagnosis(const ReportSource& source) {
  return render(source.diagnosis);
}

std::string page(const ReportSource& source) { return render_html(source.diagnosis, source.details()); }

}  // namespace

ReportDetails report_details(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                             const DiagnoseOptions& options) {
  ReportDetails details;
  details.curves = run_curves(log, model, diagnosis);
  details.model = {robot_facts(model)};
  if (model.identification.status != IdentificationStatus::not_run)
    details.model.push_back(parameter_table(model.identification));
  if (!model.validation.rows.empty()) details.model.push_back(validation_table(model.validation));
  details.provenance = {option_table(model, options), source_table(model)};
  return details;
}

std::string render_html(const Diagnosis& d, const ReportDetails& details) {
  const double zero_s = time_zero(d.log.start_s), period = d.log.sample_period_s;
  const RunCurves curves = counted_from(zero_s, details.curves);
  const std::vector<FaultFinding> faults = counted_from(zero_s, d.faults);
  const std::vector<PlotMark> marks = stop_marks(d, zero_s);
  const std::vector<PageFigure> whole = run_figures(faults, curves, marks);
  const FactTable condition = condition_table(d);
  const std::string title = verdict_sentence(d) + " " + printable(d.log.path);
  std::string text = html_head(title.substr(0, kLongestTitle), !whole.empty()) + "<body>\n" + top(d) +
                     contents(d, !condition.rows.empty(), !details.model.empty()) + "<main>\n" + stop_part(d);
  std::vector<PageFigure> all = whole;
  for (std::size_t i = 0; i < d.faults.size() && i < std::size_t{kFullFindings}; ++i) {
    const std::vector<PageFigure> figures = fault_figures(faults[i], curves, marks);
    if (i > 0 && i == curves.details.size())
      text += "<p class=\"sub\">The faults from here on have no plots of their own; see the whole run.</p>\n";
    text += html_finding(d.faults[i], figures, period);
    all.insert(all.end(), figures.begin(), figures.end());
  }
  if (!d.small_changes.empty())
    text += fmt::format("<h2 id=\"small\">{}</h2>\n", kSmallChangesTitle) + html_list(small_change_lines(d));
  if (!condition.rows.empty())
    text += fmt::format("<h2 id=\"condition\">{}</h2>\n", escaped_markup(condition.title)) +
            html_table(condition.head, condition.rows, condition.title);
  text += "<h2 id=\"run\">The whole run</h2>\n" + html_plots(whole, 0, period) + residual_table(d);
  text += log_quality(d);
  if (!details.model.empty())
    text += "<h2 id=\"model\">The model</h2>\n" + tables(details.model, "The model");
  text += provenance(d, details) + words_part() + "</main>\n";
  if (!whole.empty()) text += scripts(html_plot_data(faults, curves, all));
  return text + "</body>\n</html>\n";
}

const std::vector<ReportFormat>& report_formats() {
  static const std::vector<ReportFormat> table{
      {"json", "the diagnosis as JSON", false, from_diagnosis<render_json>},
      {"csv", "one row a fault as CSV", false, from_diagnosis<render_csv>},
      {"html", "a page to look at: plots, evidence, similar cases, provenance", true, page},
      {"md", "Markdown for an issue tracker", false, from_diagnosis<render_markdown>},
      {"junit", "JUnit XML for a CI server", false, from_diagnosis<render_junit>},
  };
  return table;
}

const ReportFormat& report_format(std::string_view name) {
  const auto& table = report_formats();
  const auto found = std::find_if(table.begin(), table.end(),
                                  [&](const ReportFormat& format) { return format.name == name; });
  if (found == table.end()) throw Error(ErrorCode::internal, std::string(name), "is not a report format");
  return *found;
}

ReportSource report_source(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                           const DiagnoseOptions& options) {
  return {diagnosis,
          [&log, &model, &diagnosis, options] { return report_details(log, model, diagnosis, options); }};
}

}  // namespace faultline
