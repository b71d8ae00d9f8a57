// SPDX-License-Identifier: MIT
#include "lib/report/markdown.hpp"

#include <fmt/format.h>

#include <string_view>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/fault/fault_words.hpp"
#include "lib/report/condition_table.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/precedent_words.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kShownFeatures = 3;

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + escaped_markdown(cell) + " |";
  return text + "\n";
}

std::string table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return "";
  std::string text = markdown_row(head) + "|";
  for (std::size_t i = 0; i < head.size(); ++i) text += " --- |";
  text += "\n";
  for (const auto& cells : rows) text += markdown_row(cells);
  return text + "\n";
}

std::string list(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = "**" + title + "**\n\n";
  for (const std::string& line : lines) text += "- " + escaped_markdown(line) + "\n";
  return text + "\n";
}

std::string or_dash(const std::string& text) { return text.empty() ? "-" : text; }

std::string fault_table(const Diagnosis& d) {
  std::vector<std::vector<std::string>> rows;
  const double period = d.log.sample_period_s;
  for (const FaultFinding& f : d.faults)
    rows.push_back({std::to_string(f.id), plain_words(f.label), onset_words(f, period),
                    clock_words(f, f.alarm_s, period), clock_words(f, f.end_s, period),
                    percent_text(f.confidence), decided_words(f)});
  return table({"fault", "what", "onset", "alarm", "end", "confidence", "decided by"}, rows);
}

std::string similar_cases_table(const FaultFinding& f) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> why;
  for (const Precedent& p : f.precedents) {
    rows.push_back({std::to_string(p.case_id), fmt::format("{:.2f}", p.similarity), plain_words(p.label),
                    or_dash(p.origin_text), or_dash(p.what_was_done)});
    if (const std::string words = likeness_words(p, kShownFeatures); !words.empty())
      why.push_back(fmt::format("case {}, {}", p.case_id, words));
  }
  const std::string cases = table({"similar case", "similarity", "fault", "origin", "action taken"}, rows);
  if (cases.empty()) return "";
  return "**" + precedents_title(f) + "**\n\n" + cases + list("Why they are similar", why);
}

std::string finding(const FaultFinding& f) {
  std::string text = fmt::format("### Fault {}: {}\n\n", f.id, escaped_markdown(plain_words(f.label)));
  if (!f.next_check.empty()) text += "**Check next:** " + escaped_markdown(f.next_check) + "\n\n";
  std::vector<std::string> others, evidence;
  for (const Alternative& a : f.could_also_be) others.push_back(plain_words(a.label) + ": " + a.why);
  for (const EvidenceItem& item : f.evidence) evidence.push_back(evidence_line(item));
  text += list("It could also be", others);
  text += similar_cases_table(f);
  if (was_asked(f.mlp) || was_asked(f.rbfn))
    text += table({"network", "names", "confidence"},
                  {{"MLP", plain_words(f.mlp.label), fmt::format("{:.2f}", f.mlp.confidence)},
                   {"RBFN", plain_words(f.rbfn.label), fmt::format("{:.2f}", f.rbfn.confidence)}});
  return text + list("Evidence", evidence);
}

std::string residuals_table(const Diagnosis& d) {
  std::vector<std::vector<std::string>> rows;
  for (const JointResidual& r : d.residuals)
    rows.push_back({std::to_string(r.joint), value_text(r.velocity_rms), value_text(r.velocity_peak),
                    time_text(r.velocity_peak_s, d.log.sample_period_s), value_text(r.position_rms)});
  return table({"joint", "velocity residual rms (1 = healthy)", "largest", "at", "position rms"}, rows);
}

std::string provenance(const Diagnosis& d) {
  std::string text = "<details><summary>Log and model</summary>\n\n";
  text += table({"", ""}, {{"log", d.log.path},
                           {"log SHA-256", d.log.sha256},
                           {"rows", std::to_string(d.log.rows_read)},
                           {"model", d.model.name},
                           {"model SHA-256", d.model.sha256},
                           {"case base SHA-256", d.model.cases_sha256},
                           {"program", "faultline " + d.program_version}});
  return text + "</details>\n";
}

}  // namespace

std::string escaped_markdown(const std::string& text) {
  static constexpr std::string_view kMarks = "\\`*_{}[]#|>~$";
  const std::string line = printable(text);
  std::string escaped;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::string_view rest = std::string_view(line).substr(i);
    if (rest.starts_with("://"))
      escaped += "&#58;";  // no link
    else if (i > 0 && line[i] == '.' && std::string_view(line).substr(0, i).ends_with("www"))
      escaped += "&#46;";
    else if (line[i] == '<')
      escaped += "&lt;";
    else if (line[i] == '&')
      escaped += "&amp;";
    else if (line[i] == '@')
      escaped += "&#64;";  // no mention
    else
      escaped += kMarks.find(line[i]) == std::string_view::npos ? std::string(1, line[i])
                                                                : std::string("\\") + line[i];
  }
  return escaped;
}

std::string render_markdown(const Diagnosis& d) {
  std::string text =
      fmt::format("## {}\n\n**{}**\n\n", escaped_markdown(d.log.path), escaped_markdown(verdict_sentence(d)));
  text += fault_table(d);
  for (const FaultFinding& f : d.faults) text += finding(f);
  text += list(kSmallChangesTitle, small_change_lines(d));
  const FactTable condition = condition_table(d);
  if (!condition.rows.empty()) text += "**" + condition.title + "**\n\n";
  text += table(condition.head, condition.rows) + residuals_table(d);
  std::vector<std::string> issues;
  for (const Issue& issue : d.log.issues.all()) issues.push_back(issue_line(issue));
  text += list("Notes on the model", d.model.notes);
  text += list("Issues of the log", issues);
  text += list("What this log and model cannot show", d.cannot_see);
  return text + provenance(d);
}

}  // namespace faultline
