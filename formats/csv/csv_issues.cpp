// SPDX-License-Identifier: MIT
#include "formats/csv/csv_issues.hpp"

#include <fmt/format.h>

#include "formats/missing.hpp"
#include "formats/provenance.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

std::string words(const CsvPlace& place) {
  return fmt::format("row {} (line {})", place.row + 1, place.line + 1);
}

}  // namespace

void CsvIssues::start() {
  issues_ = {};
  text_cells_.assign(dialect_.columns.size(), 0);
  has_text_.assign(dialect_.columns.size(), false);
  more_rows_.clear();
  if (dialect_.preamble_lines > 0)
    issues_.add({"preamble_skipped", "", Severity::note, "lines before the table were left out", 0, kNan,
                 dialect_.preamble_lines});
  if (!dialect_.time_note.empty())
    issues_.add({"time_unit_assumed", "t", Severity::note, dialect_.time_note});
  if (dialect_.names_in_rows)
    issues_.add({"names_in_rows", "", Severity::note,
                 "the file has no header; the name before each value is used as the name of its column"});
  else if (!dialect_.has_header)
    issues_.add(
        {"no_header", "", Severity::warning,
         "the file has no header; its columns are called column1, column2 and so on. Assign them in the "
         "robot file, such as [log.columns] q1 = {name = \"column2\"}"});
}

void CsvIssues::add_text(const CsvPlace& place, int column, int field, std::string_view cell) {
  const std::string& name = dialect_.columns[column].name;
  if (has_text_[column]) {
    ++text_cells_[column];
    return;
  }
  has_text_[column] = true;
  issues_.add({"not_a_number", name, Severity::warning,
               fmt::format("{}, column {} \"{}\": \"{}\" is not a number; treated as missing", words(place),
                           field + 1, shortened(name, kLongestName), shortened(cell, kLongestName)),
               place.row + 1});
}

bool CsvIssues::count_row(std::string_view code, bool dropped) {
  for (MoreRows& more : more_rows_) {
    if (more.code != code) continue;
    ++more.count;
    more.dropped += dropped;
    return true;
  }
  return false;
}

void CsvIssues::add_first_row(const CsvPlace& place, const char* code, const std::string& what, bool dropped,
                              Severity severity) {
  issues_.add({code, "", severity, words(place) + " " + what, place.row + 1, kNan, 1, dropped ? 1 : 0});
  more_rows_.push_back({code});
}

void CsvIssues::add_provenance(std::string_view text) { issues_.add(issue_from_provenance(text)); }

const Issues& CsvIssues::all() const {
  for (std::size_t i = 0; i < text_cells_.size(); ++i) {
    if (text_cells_[i] == 0) continue;
    issues_.add({"not_a_number", dialect_.columns[i].name, Severity::note, "", 0, kNan, text_cells_[i]});
    text_cells_[i] = 0;
  }
  for (MoreRows& more : more_rows_) {
    if (more.count == 0) continue;
    issues_.add({more.code, "", Severity::note, "", 0, kNan, more.count, more.dropped});
    more.count = more.dropped = 0;
  }
  return issues_;
}

}  // namespace faultline
