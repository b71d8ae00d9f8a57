// SPDX-License-Identifier: MIT
#include "lib/batch/page/index_page.hpp"

#include <fmt/format.h>

#include "lib/batch/page/index_assets.hpp"
#include "lib/batch/page/index_table.hpp"
#include "lib/batch/page/index_trends.hpp"
#include "lib/core/markup.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/html/elements.hpp"
#include "lib/html/source_hash.hpp"

namespace faultline {
namespace {

std::string head(const BatchSummary& summary) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src {}; style-src {}; "
      "base-uri 'none'; form-action 'none'\">\n<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<title>{} logs, model {}</title>\n<style>{}</style>\n</head>\n",
      source_hash(index_script()), source_hash(index_style()), summary.all.logs,
      escaped_markup(printable(summary.facts.model.name).substr(0, 200)), index_style());
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

std::string folder_table(const BatchSummary& summary) {
  std::vector<HtmlRow> rows;
  for (const auto& [folder, counts] : summary.folders)
    rows.push_back(counts_row(folder.empty() ? "(given files)" : folder, counts));
  return "<h2>By folder</h2>\n<div class=\"wide\">" +
         html_table({"folder", "logs", "healthy", "faulty", "inconclusive", "unusable", "faults", "hours",
                     "faults per hour", "median residual", "largest"},
                    rows) +
         "</div>\n";
}

std::string kind_table(const BatchSummary& summary) {
  std::vector<HtmlRow> rows;
  for (const auto& [kind, joints] : summary.kinds)
    for (const auto& [joint, count] : joints)
      rows.push_back({kind, joint > 0 ? std::to_string(joint) : "-", std::to_string(count)});
  return rows.empty() ? "" : "<h2>Faults by kind</h2>\n" + html_table({"fault", "joint", "times"}, rows);
}

std::string options_of_kind(const BatchSummary& summary) {
  std::string text;
  for (const auto& [kind, joints] : summary.kinds) text += "<option>" + escaped_markup(kind) + "</option>";
  return text;
}

std::string tools(const BatchSummary& summary) {
  return "<div class=\"tools\"><label>Find <input id=\"text\" type=\"search\"></label><label>Verdict <select "
         "id=\"verdict\"><option value=\"\">all</option><option>faulty</option><option>healthy</option>"
         "<option>inconclusive</option><option>unusable</option><option>failed</option></select></label>"
         "<label>Fault <select id=\"kind\"><option value=\"\">all</option>" +
         options_of_kind(summary) + "</select></label><span id=\"shown\" role=\"status\"></span></div>\n";
}

std::string provenance(const BatchFacts& facts) {
  std::vector<HtmlRow> rows = {{"model", printable(facts.model.name)},
                               {"model SHA-256", facts.model.sha256},
                               {"case base SHA-256", facts.model.cases_sha256},
                               {"program", "faultline " + facts.program_version},
                               {"options", facts.options}};
  for (const std::string& note : facts.model.notes) rows.push_back({"note", printable(note)});
  return "<h2>Provenance</h2>\n" + html_table({}, rows);
}

}  // namespace

std::string render_index_page(const std::vector<BatchRow>& rows, const BatchSummary& summary, bool pages) {
  const BatchFacts& facts = summary.facts;
  std::string text = head(summary) + "<body>\n";
  text += fmt::format(
      "<h1>{}, {}</h1>\n<p class=\"sub\">Model {}{}</p>\n", counted(summary.all.logs, "log"),
      counted(summary.all.faults, "fault"), escaped_markup(printable(facts.model.name).substr(0, 200)),
      facts.shards > 1 ? fmt::format("; part {} of {} of {} logs", facts.shard, facts.shards, facts.logs)
                       : "");
  text += counts_line(summary.all) + folder_table(summary) + kind_table(summary) + index_trends(rows);
  text += "<h2>Logs</h2>\n" + tools(summary) + index_table(rows, pages) + provenance(facts);
  return text + "<script>" + std::string(index_script()) + "</script>\n</body>\n</html>\n";
}

}  // namespace faultline
