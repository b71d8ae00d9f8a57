// SPDX-License-Identifier: MIT
#include "lib/batch/page/index_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lib/batch/batch_row.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_catalogue.hpp"
#include "lib/report/html/elements.hpp"

namespace faultline {
namespace {

constexpr double kWidth = 160.0;
constexpr int kLane = 6;

struct Scale {
  double start_s, end_s;
  double x(double time_s) const {
    return std::clamp((time_s - start_s) / (end_s - start_s), 0.0, 1.0) * kWidth;
  }
};

std::string bar(const char* kind, double from, double to, int y) {
  return fmt::format("<rect{} x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"4\"/>", kind, from, y,
                     std::max(to - from, 1.0));
}

std::string fault_bars(const FaultEvent& fault, const Scale& scale, int y) {
  if (!std::isfinite(fault.onset_s)) return "";
  const double onset = scale.x(fault.onset_s);
  const double alarm = std::isfinite(fault.alarm_s) ? std::max(scale.x(fault.alarm_s), onset) : onset;
  const double end = std::isfinite(fault.end_s) ? scale.x(fault.end_s) : kWidth;
  const std::string before = alarm - onset >= 0.1 ? bar("", onset, alarm, y) : "";
  return before + bar(" class=\"f\"", alarm, end, y);
}

constexpr std::size_t kLongestName = 200;
constexpr int kNamedModels = 3;  // in a title

constexpr std::size_t kShownFolders = 200;  // a table of more makes the page slow
constexpr std::size_t kLongestDoubt = 400;  // bytes of a sentence about the model

/// "model bench", safe in markup.
std::string models_text(const BatchFacts& facts) {
  std::string names;
  int count = 0;
  for (const ModelFacts& model : facts.models)
    if (++count <= kNamedModels)
      names += (names.empty() ? "" : ", ") + printable(model.name).substr(0, kLongestName);
  if (count > kNamedModels) names += fmt::format(" and {} more", count - kNamedModels);
  return escaped_markup((count == 1 ? "model " : "models ") + names);
}

/// A table that scrolls on its own where the page is too narrow for it, also by keyboard.
std::string scrolling(const std::string& label, const std::string& table) {
  return "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"" + label + "\">" + table +
         "</div>\n";
}

std::string head(const BatchSummary& summary) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src {}; style-src {}; "
      "base-uri 'none'; form-action 'none'\">\n<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<title>{} logs, {}</title>\n<style>{}</style>\n</head>\n",
      source_hash(index_script()), source_hash(index_style()), summary.all.logs, models_text(summary.facts),
      index_style());
}

std::string counts_line(const BatchCounts& counts) {
  std::string text = "<ul class=\"counts\">";
  const auto item = [&](const char* verdict, int count) {
    if (count > 0) text += fmt::format("<li class=\"{}\"><b>{}</b> {}</li>", verdict, count, verdict);
  };
  item("faulty", counts.faulty);
  item("healthy", counts.healthy);
  item("inconclusive", counts.inconclusive);
  item("unusable", counts.unusable);
  item("failed", counts.failed);
  return text + "</ul>\n";
}

HtmlRow counts_row(const std::string& name, const BatchCounts& c) {
  return {printable(name),
          std::to_string(c.logs),
          std::to_string(c.healthy),
          std::to_string(c.faulty),
          std::to_string(c.inconclusive),
          std::to_string(c.unusable + c.failed),
          std::to_string(c.faults),
          c.hours > 0.0 ? value_text(c.hours) : "-",
          c.hours > 0.0 ? value_text(c.faults / c.hours) : "-",
          value_text(c.median_residual),
          value_text(c.largest_residual)};
}

HtmlRow counts_head(const char* what) {
  return {what,     "logs",  "healthy",         "faulty",          "inconclusive", "unusable",
          "faults", "hours", "faults per hour", "median residual", "largest"};
}

/// For the choice among many folders: the largest residual, below all where no log was judged.
double rank_of(const BatchCounts& counts) {
  return std::isfinite(counts.largest_residual) ? counts.largest_residual : -1.0;
}

/// Of many folders those with the largest residuals, in the order of their names.
std::string folder_table(const BatchSummary& summary) {
  std::vector<double> ranks;
  for (const auto& [folder, counts] : summary.folders) ranks.push_back(rank_of(counts));
  const std::size_t folders = ranks.size(), shown = std::min(folders, kShownFolders);
  std::sort(ranks.begin(), ranks.end(), std::greater<>());
  std::vector<HtmlRow> rows;
  for (const auto& [folder, counts] : summary.folders)
    if (rows.size() < shown && rank_of(counts) >= ranks[shown - 1])
      rows.push_back(counts_row(folder.empty() ? "(given files)" : folder, counts));
  std::string text = "<h2>By folder</h2>\n";
  if (shown < folders)
    text += fmt::format("<p>The {} of {} folders with the largest residuals; summary.json has all.</p>\n",
                        shown, folders);
  return text + scrolling("Counts by folder", html_table(counts_head("folder"), rows));
}

/// Only where there are several models.
std::string model_table(const BatchSummary& summary) {
  std::vector<HtmlRow> rows;
  for (const ModelFacts& model : summary.facts.models)
    if (const auto counts = summary.models.find(model.sha256); counts != summary.models.end())
      rows.push_back(counts_row(model.name, counts->second));
  if (rows.size() < 2) return "";
  return "<h2>By model</h2>\n" + scrolling("Counts by model", html_table(counts_head("model"), rows));
}

std::string kind_table(const BatchSummary& summary) {
  std::vector<HtmlRow> rows;
  for (const auto& [kind, joints] : summary.kinds)
    for (const auto& [joint, count] : joints)
      rows.push_back({kind, joint.is_none() ? "-" : fmt::format("{}", joint), std::to_string(count)});
  return rows.empty() ? ""
                      : "<h2>Faults by kind</h2>\n" +
                            scrolling("Faults by kind", html_table({"fault", "joint", "times"}, rows));
}

std::string trends(const std::vector<BatchRow>& rows) {
  const std::string still = index_trends(rows);
  if (still.empty()) return "";
  return "<h2>Trends</h2>\n<div id=\"trends-live\"></div>\n<noscript>" + still + "</noscript>\n";
}

/// Of each model that has logs.
std::string wear_part(const BatchSummary& summary) {
  std::string text;
  for (const RobotWear& wear : summary.wear) {
    if (summary.wear.size() > 1)
      text += "<h3>" + escaped_markup(printable(wear.robot).substr(0, kLongestName)) + "</h3>\n";
    if (wear.not_applicable.empty())
      text += wear.by_date
                  ? "<p>By the dates of the logs.</p>\n"
                  : "<p>In the order of the files: trends by date are not applicable, since not every "
                    "log contains a date.</p>\n";
    text += wear_table(wear);
  }
  if (text.empty()) return "";
  return "<h2>Wear</h2>\n<p>Condition from log to log against the model, with 95 % intervals. Beyond chance: of "
         "robots that do not change, one in 100 shows such a change.</p>\n" +
         text;
}

/// Only if there are several models or pairs of joints.
std::string twins_part(const BatchSummary& summary) {
  std::string text;
  if (summary.wear.size() > 1) text += "<h3>Robots</h3>\n" + twins_html(summary.robots);
  if (!summary.facts.twins.empty()) text += "<h3>Pairs of joints</h3>\n" + twins_html(summary.joints);
  if (text.empty()) return "";
  return "<h2>Twins</h2>\n<p>Condition of robots and joints of a kind, each against its own model; listed is what "
         "differs from the others more than they scatter. Of batches of equals, one in 100 lists something.</p>\n" +
         text;
}

std::string options_of_kind(const BatchSummary& summary) {
  std::string text;
  for (const auto& [kind, joints] : summary.kinds) text += "<option>" + escaped_markup(kind) + "</option>";
  return text;
}

/// By their place in the batch; nothing for one model.
std::string options_of_models(const BatchFacts& facts) {
  if (facts.models.size() < 2) return "";
  std::string text;
  for (std::size_t i = 0; i < facts.models.size(); ++i)
    text += fmt::format("<option value=\"{}\">{}</option>", i,
                        escaped_markup(printable(facts.models[i].name).substr(0, kLongestName)));
  return "<label>Model <select id=\"model\"><option value=\"\">all</option>" + text + "</select></label>";
}

std::string tools(const BatchSummary& summary) {
  const std::string models = options_of_models(summary.facts);
  return "<div class=\"tools\"><label>Find <input id=\"text\" type=\"search\"></label><label>Verdict <select "
         "id=\"verdict\"><option value=\"\">all</option><option>faulty</option><option>healthy</option>"
         "<option>inconclusive</option><option>unusable</option><option>failed</option></select></label>"
         "<label>Fault <select id=\"kind\"><option value=\"\">all</option>" +
         options_of_kind(summary) + "</select></label>" + models +
         "<details id=\"choice\"><summary>Columns</summary><fieldset><legend>Columns to show</legend></fieldset>"
         "</details><span id=\"shown\" role=\"status\"></span></div>\n";
}

std::string fault_list(const BatchRow& row) {
  std::string list;
  for (const FaultEvent& fault : row.faults)
    list +=
        (list.empty() ? "" : "<br>") +
        escaped_markup(fmt::format("{} at {} (confidence {})", plain_words(fault.label),
                                   onset_words(fault, row.sample_period_s), percent_text(fault.confidence)));
  if (list.empty() && row.verdict != "healthy") list = escaped_markup(printable(row.reason).substr(0, 400));
  return list;
}

std::string verdict_cell(const BatchRow& row) {
  if (row.doubt.empty()) return row.verdict;
  return fmt::format("{}<br><span title=\"{}\">doubtful model</span>", row.verdict,
                     escaped_markup(printable(row.doubt).substr(0, kLongestDoubt)));
}

std::string log_cell(const BatchRow& row, bool pages) {
  const std::string name = escaped_markup(printable(row.log).substr(0, 400));
  if (row.result.empty()) return name;
  return fmt::format("<a href=\"logs/{}.{}\">{}</a>", row.result, pages ? "html" : "json", name);
}

std::string number_cell(double value, const std::string& shown) {
  return "<td class=\"n\">" + (std::isfinite(value) ? shown : std::string("-")) + "</td>";
}

std::string table_row(const BatchRow& row, std::size_t number, bool pages) {
  const double duration = row.end_s - row.start_s, level = residual_level(row);
  const int issues = row.warnings + row.severe;
  return fmt::format("<tr><td class=\"n\">{}</td><td>{}</td><td class=\"{}\">{}</td><td>{}</td><td>{}</td>",
                     number, log_cell(row, pages), row.verdict, verdict_cell(row), fault_list(row),
                     index_thumbnail(row)) +
         number_cell(level, value_text(level)) + number_cell(duration, value_text(duration)) +
         number_cell(issues, std::to_string(issues)) + "</tr>\n";
}

/// Where the scripts put the table of logs, and for readers without them a plain one: a row each, which leads
/// to logs/<result>.html with `pages`, else to the JSON.
std::string index_table(const std::vector<BatchRow>& rows, bool pages) {
  std::string text =
      "<div id=\"table\"></div>\n<noscript><table class=\"logs\">\n<thead><tr><th class=\"c1\" scope=\"col\">no.</th><th "
      "class=\"c2\" scope=\"col\">log</th><th class=\"c3\" scope=\"col\">verdict</th><th class=\"c4\" "
      "scope=\"col\">faults</th><th class=\"c5\" scope=\"col\">timeline</th><th class=\"c6\" "
      "scope=\"col\">residual</th><th class=\"c7\" scope=\"col\">length, s</th><th class=\"c8\" "
      "scope=\"col\">issues</th></tr></thead>\n<tbody>\n";
  const std::size_t count = std::min(rows.size(), kIndexFirstRows);
  for (std::size_t i = 0; i < count; ++i) text += table_row(rows[i], i + 1, pages);
  text += "</tbody></table>\n";
  if (count < rows.size())
    text += fmt::format(
        "<p>The first {} of {} logs; with scripts enabled this page shows all, as does index.csv.</p>\n",
        count, rows.size());
  return text + "</noscript>\n";
}

std::string provenance(const BatchFacts& facts) {
  std::vector<HtmlRow> rows = {{"program", "faultline " + facts.program_version}, {"options", facts.options}};
  for (const ModelFacts& model : facts.models) {
    rows.push_back({"model", printable(model.name)});
    rows.push_back({"its SHA-256", model.sha256});
    rows.push_back({"SHA-256 of its case base", model.cases_sha256});
    for (const std::string& note : model.notes) rows.push_back({"note", printable(note)});
  }
  return "<h2>Provenance</h2>\n" + scrolling("Provenance", html_table({}, rows));
}

/// The scripts stand before the packed parts, so that the first rows are there before the page is.
std::string scripts(const IndexData& data) {
  std::string text = "<script type=\"application/json\" id=\"index-facts\">" + data.facts +
                     "</script>\n<script>" + std::string(index_script()) + "</script>\n";
  for (const std::string& part : data.parts)
    text += "<script type=\"text/plain\" class=\"part\">" + part + "</script>\n";
  return text;
}

}  // namespace

std::string index_thumbnail(const BatchRow& row) {
  const Scale scale{row.start_s, row.end_s};
  if (!(scale.end_s > scale.start_s)) return "";
  int first = 1, last = std::max(row.joints, 1);  // numbers of joints; 0 for faults of none
  for (const FaultEvent& fault : row.faults) {
    first = std::min(first, fault.label.joint.number());
    last = std::max(last, fault.label.joint.number());
  }
  std::string lanes, bars;
  for (int number = first; number <= last; ++number)
    lanes += fmt::format("M0 {}h{}", (number - first) * kLane + 3, kWidth);
  for (const FaultEvent& fault : row.faults)
    bars += fault_bars(fault, scale, (fault.label.joint.number() - first) * kLane + 1);
  return fmt::format("<svg class=\"t\" viewBox=\"0 0 160 {}\" aria-hidden=\"true\"><path d=\"{}\"/>{}</svg>",
                     (last - first + 1) * kLane, lanes, bars);
}

std::string render_index_page(const std::vector<BatchRow>& rows, const BatchSummary& summary, bool pages) {
  const BatchFacts& facts = summary.facts;
  std::string text = head(summary) + "<body>\n<main>\n";
  text += fmt::format(
      "<h1>{}, {}</h1>\n<p class=\"sub\">Diagnosed with {}{}</p>\n", counted(summary.all.logs, "log"),
      counted(summary.all.faults, "fault"), models_text(facts),
      facts.shards > 1 ? fmt::format("; part {} of {} of {} logs", facts.shard, facts.shards, facts.logs)
                       : "");
  text += counts_line(summary.all) + model_table(summary) + folder_table(summary) + kind_table(summary) +
          trends(rows) + wear_part(summary) + twins_part(summary);
  text += "<h2 id=\"list\">Logs</h2>\n" + tools(summary) + index_table(rows, pages) + provenance(facts) +
          "</main>\n";
  return text + scripts(index_data(rows, facts, pages)) + "</body>\n</html>\n";
}

}  // namespace faultline
