// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <string_view>

#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/diagnose/fault_event.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/report/finding_words.hpp"
#include "lib/report/stop_report.hpp"
#include "lib/report/text.hpp"

namespace faultline {
namespace {

constexpr std::size_t kShownFeatures = 3;

/// Text that Markdown shows as it is, also in a cell of a table; one line.
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

std::string fault_table(const Diagnosis& d) {
  std::vector<std::vector<std::string>> rows;
  for (const FaultFinding& f : d.faults) rows.push_back(fault_cells(f, d.log.sample_period_s));
  return table({"fault", "what", "onset", "alarm", "end", "confidence", "decided by"}, rows);
}

std::string similar_cases_table(const FaultFinding& f) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> why;
  for (const Precedent& p : known_precedents(f)) {
    rows.push_back(precedent_cells(p));
    if (const std::string words = likeness_words(p, kShownFeatures); !words.empty())
      why.push_back(fmt::format("case {}, {}", p.case_id, words));
  }
  std::string cases = table({"similar case", "similarity", "fault", "origin", "action taken"}, rows) +
                      list("Why they are similar", why);
  if (const std::string words = simulated_precedents_words(f); !words.empty())
    cases += "- " + escaped_markdown(words) + "\n\n";
  return cases.empty() ? "" : "**" + precedents_title(f) + "**\n\n" + cases;
}

std::string finding(const FaultFinding& f) {
  std::string text = fmt::format("### Fault {}: {}\n\n", f.id, escaped_markdown(plain_words(f.label)));
  if (!f.next_check.empty()) text += "**Check next:** " + escaped_markdown(f.next_check) + "\n\n";
  text += list("It could also be", alternative_lines(f));
  text += similar_cases_table(f);
  text += table({"network", "names", "confidence"}, opinion_rows(f));
  return text + list("Evidence", evidence_lines(f));
}

/// The answer about the stop that was asked about; empty if none was.
std::string stop_section(const Diagnosis& d) {
  if (!d.stop) return "";
  const StopAnswer& stop = *d.stop;
  std::string text = "### " + escaped_markdown(stop_title(stop, d.log.sample_period_s)) + "\n\n";
  for (const std::string& line : stop.summary) text += "- " + escaped_markdown(line) + "\n";
  text += "\n";
  const FactTable signals = stop_signal_table(stop, d.log.sample_period_s);
  if (!signals.rows.empty()) text += "**" + signals.title + "**\n\n" + table(signals.head, signals.rows);
  if (stop.short_log) text += list("How much so short a log shows", stop.short_log->notes);
  const FactTable reach = stop_reach_table(stop);
  if (!reach.rows.empty()) text += "**" + reach.title + "**\n\n" + table(reach.head, reach.rows);
  return text + list("Not looked at", stop.not_looked_at);
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

std::string render_markdown(const Diagnosis& d) {
  std::string text = fmt::format("## {}\n\nLog: {}\n\n", escaped_markdown(verdict_sentence(d)),
                                 escaped_markdown(d.log.path));
  text += fault_table(d) + stop_section(d);
  for (const FaultFinding& f : d.faults) text += finding(f);
  text += list(kSmallChangesTitle, small_change_lines(d));
  const FactTable condition = condition_table(d);
  if (!condition.rows.empty()) text += "**" + condition.title + "**\n\n";
  text += table(condition.head, condition.rows);
  text += table({"joint", "velocity residual rms (1 = healthy)", "largest", "at", "position rms"},
                residual_rows(d));
  text += list("Notes on the model", d.model.notes);
  text += list("Issues of the log", issue_lines(d.log.issues));
  text += list("What this log and model cannot show", d.cannot_see);
  return text + provenance(d);
}

}  // namespace faultline
