// SPDX-License-Identifier: MIT
#include "lib/batch/page/index_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/batch/page/index_thumbnail.hpp"
#include "lib/core/markup.hpp"
#include "lib/core/number_text.hpp"
#include "lib/core/text.hpp"
#include "lib/fault/fault_words.hpp"

namespace faultline {
namespace {

constexpr std::size_t kLongestDoubt = 400;  // bytes of a sentence about the model
constexpr std::size_t kStillRows = 500;     // without script; more would cost those who have one

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

}  // namespace

std::string index_table(const std::vector<BatchRow>& rows, bool pages) {
  std::string text =
      "<div id=\"table\"></div>\n<noscript><table class=\"logs\">\n<thead><tr><th class=\"c1\" scope=\"col\">no.</th><th "
      "class=\"c2\" scope=\"col\">log</th><th class=\"c3\" scope=\"col\">verdict</th><th class=\"c4\" "
      "scope=\"col\">faults</th><th class=\"c5\" scope=\"col\">timeline</th><th class=\"c6\" "
      "scope=\"col\">residual</th><th class=\"c7\" scope=\"col\">length, s</th><th class=\"c8\" "
      "scope=\"col\">issues</th></tr></thead>\n<tbody>\n";
  const std::size_t count = std::min(rows.size(), kStillRows);
  for (std::size_t i = 0; i < count; ++i) text += table_row(rows[i], i + 1, pages);
  text += "</tbody></table>\n";
  if (count < rows.size())
    text += fmt::format("<p>The first {} of {} logs; a script shows all, as index.csv does.</p>\n", count,
                        rows.size());
  return text + "</noscript>\n";
}

}  // namespace faultline
