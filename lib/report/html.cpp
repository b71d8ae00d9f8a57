// SPDX-License-Identifier: MIT
#include "lib/report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/diagnosis/fault_words.hpp"
#include "lib/report/layout.hpp"
#include "lib/report/markup.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

constexpr const char* kStyle =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#1b1f24;"
    "background:#fff}table{border-collapse:collapse}td,th{padding:.15rem .8rem .15rem 0;text-align:left;"
    "vertical-align:top}svg{width:100%;height:auto}.faulty{color:#b3261e}.healthy{color:#1b7f3b}"
    ".inconclusive,.not_run{color:#9a6700}section{border-left:.25rem solid "
    "#b3261e;padding-left:1rem;margin:1.5rem 0}";

using Row = std::vector<std::string>;

std::string table(const Row& head, const std::vector<Row>& rows) {
  std::string text = "<table>\n<tr>";
  for (const std::string& cell : head) text += "<th>" + escaped_markup(cell) + "</th>";
  text += "</tr>\n";
  for (const Row& row : rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += "<td>" + escaped_markup(cell) + "</td>";
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

std::string section(const char* title, const std::string& content) {
  return content.empty() ? "" : fmt::format("<h3>{}</h3>\n{}", title, content);
}

std::string items(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "<li>" + escaped_markup(line) + "</li>\n";
  return text.empty() ? "" : "<ul>\n" + text + "</ul>\n";
}

/// The run on 0..1000, a lane of 28 a joint; lane 0 is for faults of no joint.
class Picture {
 public:
  explicit Picture(const Diagnosis& d) : d_(d), span_s_(d.log.end_s - d.log.start_s) {
    for (const FaultFinding& f : d.faults) {
      joints_ = std::max(joints_, f.label.joint);
      first_lane_ = f.label.joint > 0 ? first_lane_ : 0;
    }
  }

  std::string text() const {
    if (!(std::isfinite(span_s_) && span_s_ > 0.0)) return "";
    std::string svg = fmt::format("<svg viewBox=\"0 0 1100 {}\" role=\"img\" aria-label=\"Timeline\">\n",
                                  lane_y(joints_) + 50);
    for (int lane = first_lane_; lane <= joints_; ++lane) svg += lane_text(lane);
    for (const FaultFinding& fault : d_.faults) svg += fault_text(fault);
    const int y = lane_y(joints_) + 40;
    svg += fmt::format("<text x=\"90\" y=\"{}\" font-size=\"14\">{}</text>", y,
                       time_text(d_.log.start_s, d_.log.sample_period_s));
    svg += fmt::format("<text x=\"1090\" y=\"{}\" font-size=\"14\" text-anchor=\"end\">{}</text>\n", y,
                       time_text(d_.log.end_s, d_.log.sample_period_s));
    return svg + "</svg>\n";
  }

 private:
  int lane_y(int lane) const { return 8 + 28 * (lane - first_lane_); }

  double x_of(double time_s) const {
    return 90.0 + 1000.0 * std::clamp((time_s - d_.log.start_s) / span_s_, 0.0, 1.0);
  }

  std::string lane_text(int lane) const {
    const std::string name = lane > 0 ? fmt::format("joint {}", lane) : "robot";
    return fmt::format(
        "<text x=\"0\" y=\"{}\" font-size=\"16\">{}</text><rect x=\"90\" y=\"{}\" width=\"1000\" "
        "height=\"6\" fill=\"#c9d1d9\"/>\n",
        lane_y(lane) + 16, name, lane_y(lane) + 8);
  }

  std::string fault_text(const FaultFinding& f) const {
    if (!std::isfinite(f.onset_s)) return "";
    const int y = lane_y(std::max(f.label.joint, 0));
    const double x = x_of(f.onset_s), end = std::isfinite(f.end_s) ? x_of(f.end_s) : 1090.0;
    std::string svg = fmt::format(
        "<rect x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"22\" fill=\"#b3261e\"><title>"
        "Fault {}: {}</title></rect>",
        x, y, std::max(end - x, 2.0), f.id, escaped_markup(plain_words(f.label)));
    if (std::isfinite(f.alarm_s))
      svg += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{}\" width=\"3\" height=\"26\" fill=\"#1b1f24\"><title>alarm</title>"
          "</rect>",
          x_of(f.alarm_s), y - 2);
    return svg + "\n";
  }

  const Diagnosis& d_;
  double span_s_;
  int joints_ = d_.log.joints;
  int first_lane_ = 1;
};

std::vector<std::string> evidence_lines(const FaultFinding& fault) {
  std::vector<std::string> lines;
  for (const EvidenceItem& e : fault.evidence) {
    const std::string value = std::isnan(e.value) ? "" : ": " + value_text(e.value) + " " + e.unit;
    lines.push_back((e.text.empty() ? e.name : e.text) + value);
  }
  return lines;
}

std::string fault_section(const FaultFinding& f, const LogFacts& log) {
  std::vector<Row> similar;
  std::vector<std::string> others;
  for (const Precedent& p : f.precedents)
    similar.push_back({std::to_string(p.case_id), fmt::format("{:.2f}", p.similarity), plain_words(p.label),
                       p.what_was_done});
  for (const Alternative& a : f.could_also_be) others.push_back(plain_words(a.label) + ": " + a.why);
  const double period = log.sample_period_s;
  std::string text =
      fmt::format("<section>\n<h2>Fault {}: {}</h2>\n", f.id, escaped_markup(plain_words(f.label)));
  text += table({"onset", "alarm", "end", "confidence", "decided by"},
                {{time_text(f.onset_s, period), time_text(f.alarm_s, period), time_text(f.end_s, period),
                  fmt::format("{:.0f} %", 100.0 * f.confidence), to_string(f.decided_by)}});
  text += table({"network", "says", "confidence"},
                {{"MLP", plain_words(f.mlp.label), fmt::format("{:.2f}", f.mlp.confidence)},
                 {"RBFN", plain_words(f.rbfn.label), fmt::format("{:.2f}", f.rbfn.confidence)}});
  text += section("Check next", "<p>" + escaped_markup(f.next_check) + "</p>\n");
  text += section("It could also be", items(others));
  text += section("Similar cases",
                  similar.empty() ? "" : table({"case", "similarity", "was", "done then"}, similar));
  return text + section("Evidence", items(evidence_lines(f))) + "</section>\n";
}

std::string residuals(const Diagnosis& d) {
  std::vector<Row> rows;
  for (const JointResidualSummary& r : d.residuals)
    rows.push_back({std::to_string(r.joint), value_text(r.velocity_rms), value_text(r.velocity_peak),
                    time_text(r.peak_s, d.log.sample_period_s), value_text(r.position_rms)});
  return rows.empty() ? "" : table({"joint", "velocity rms", "largest", "at", "position rms"}, rows);
}

std::string issues(const Diagnosis& d) {
  std::vector<Row> rows;
  for (const Issue& issue : d.log.issues.all())
    rows.push_back({to_string(issue.severity), issue.code, issue.channel, std::to_string(issue.count),
                    std::to_string(issue.rows_dropped), issue.message});
  return rows.empty() ? "" : table({"severity", "code", "channel", "times", "rows left out", "what"}, rows);
}

std::string facts(const Diagnosis& d) {
  return table({"", ""}, {{"log", d.log.path},
                          {"log sha256", d.log.sha256},
                          {"format", d.log.format},
                          {"rows", std::to_string(d.log.rows_read)},
                          {"model", d.model.name},
                          {"model sha256", d.model.sha256},
                          {"cases sha256", d.model.cases_sha256},
                          {"program", "faultline " + d.program_version}});
}

}  // namespace

std::string render_html(const Diagnosis& d) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>{0}</title>\n<style>{1}</style></head>\n<body>\n<h1>{0}</h1>\n"
      "<p class=\"{2}\"><strong>{3}</strong></p>\n",
      escaped_markup(d.log.path), kStyle, to_string(d.verdict), escaped_markup(verdict_sentence(d)));
  if (d.verdict == Verdict::healthy || !d.faults.empty()) text += Picture(d).text();
  for (const FaultFinding& fault : d.faults) text += fault_section(fault, d.log);
  text += section("Residuals against the regenerated fault-free motion (1 = as in the healthy logs)",
                  residuals(d));
  text += section("What was wrong with the log", issues(d));
  text += section("What this log and model cannot show", items(d.cannot_see));
  return text + section("Facts", facts(d)) + "</body></html>\n";
}

}  // namespace faultline
