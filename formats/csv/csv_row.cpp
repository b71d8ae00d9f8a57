// SPDX-License-Identifier: MIT
#include "formats/csv/csv_row.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/csv/csv_dialect.hpp"
#include "formats/csv/csv_fields.hpp"
#include "formats/provenance.hpp"
#include "lib/core/text.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/log/units.hpp"

namespace faultline {
namespace {

std::string words(const CsvPlace& place) {
  return fmt::format("row {} (line {})", place.row + 1, place.line + 1);
}

/// The last line of an export of TwinCAT Scope, where that was asked for.
constexpr std::string_view kEndOfExport = "EOF";

constexpr std::size_t kQuotedBytes = 240;  // of a line; enough for the characters that are shown

/// A header among the rows of a table, as in concatenated files.
struct LaterHeader {
  std::vector<int> fields;  ///< of each column of the table; -1 for a column that it lacks
  bool has_all = false;     ///< the same columns with the same units in any order, and no others
};

/// Returns the field that names the column; -1 for none.
int field_of(const RawColumn& column, bool unit_stood_there, const std::vector<NameAndUnit>& names) {
  for (std::size_t f = 0; f < names.size(); ++f)
    if (names[f].name == column.name && (!unit_stood_there || names[f].unit == column.unit))
      return static_cast<int>(f);
  return -1;
}

/// Returns nullopt for a line that is no header: a header has no number and at least half of the table's
/// columns.
std::optional<LaterHeader> find_later_header(const CsvDialect& dialect,
                                             const std::vector<std::string_view>& fields) {
  if (!dialect.has_header || dialect.columns.size() < 2) return {};
  std::vector<NameAndUnit> names;
  for (const std::string_view field : fields) {
    const CellKind kind = read_cell(field, dialect.decimal).kind;
    if (kind == CellKind::number) return {};
    names.push_back(split_unit(std::string(field)));
  }
  const bool has_units =
      std::any_of(names.begin(), names.end(), [](const NameAndUnit& name) { return !name.unit.empty(); });
  LaterHeader header;
  for (const RawColumn& column : dialect.columns) header.fields.push_back(field_of(column, has_units, names));
  const auto lacking = std::count(header.fields.begin(), header.fields.end(), -1);
  if (2 * lacking > static_cast<std::ptrdiff_t>(header.fields.size())) return {};
  header.has_all = lacking == 0 && static_cast<int>(fields.size()) == dialect.fields;
  return header;
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
  issues_.merge(dialect_.issues);
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

CsvRowReader::CsvRowReader(const CsvDialect& dialect, CsvIssues& issues)
    : dialect_(dialect),
      issues_(issues),
      wanted_(dialect.columns.size(), true),
      wide_(dialect.separator, dialect.decimal) {
  start();
}

void CsvRowReader::start() {
  absent_fields_ = 0;
  is_other_table_ = false;
  place_columns(dialect_.value_fields);
}

void CsvRowReader::want(const std::vector<bool>& columns) {
  wanted_ = columns;
  place_columns(value_fields_);
}

/// Sets the field of each column for the following rows.
void CsvRowReader::place_columns(const std::vector<int>& fields) {
  value_fields_ = fields;
  column_of_field_.assign(dialect_.fields, -1);
  for (std::size_t i = 0; i < wanted_.size(); ++i)
    if (wanted_[i]) column_of_field_[value_fields_[i]] = static_cast<int>(i);
}

void CsvRowReader::begin_block(RawBlock& block, int max_rows) {
  block.columns.resize(dialect_.columns.size());
  for (std::size_t i = 0; i < wanted_.size(); ++i)
    if (wanted_[i]) block.columns[i].resize(max_rows);
  block_ = &block;
  find_places();
}

void CsvRowReader::find_places() {
  field_values_.assign(dialect_.fields, nullptr);
  for (int field = 0; field < dialect_.fields; ++field)
    if (const int column = column_of_field_[field]; column >= 0)
      field_values_[field] = block_->columns[column].data();
}

int CsvRowReader::read_many(const char*& p, const char* end, int row, int max_rows) {
  if (is_other_table_ || !wide_.can_read()) return 0;
  return wide_.read(p, end, field_values_, row, max_rows);
}

const char* CsvRowReader::read_plain(const char* p, const char* end, int row) {
  if (is_other_table_) return nullptr;
  const char separator = dialect_.separator;
  const bool blanks = separator == ' ';
  const fast_float::parse_options options(fast_float::chars_format::general, dialect_.decimal);
  const int fields = dialect_.fields;
  for (int field = 0; field < fields; ++field) {
    while (*p == ' ' || (blanks && *p == '\t')) ++p;
    if (double* values = field_values_[field]) {
      const auto [after, error] = fast_float::from_chars_advanced(p, end, values[row], options);
      if (error != std::errc()) return nullptr;
      p = after;
    } else {
      while (*p != separator && *p != '\n' && *p != '"' && !(blanks && *p == '\t')) ++p;
    }
    if (field + 1 == fields) break;
    if (*p != separator && !(blanks && *p == '\t')) return nullptr;
    ++p;
  }
  while (*p == ' ' || *p == '\r') ++p;
  return *p == '\n' ? p + 1 : nullptr;
}

CsvRow CsvRowReader::read_open(std::string_view line, std::string_view before, const CsvPlace& at, int row) {
  LastCells usual = dialect_.last_cells;
  for (std::size_t begin = 0; begin < before.size();) {
    const std::size_t end = std::min(before.find('\n', begin), before.size());
    const std::string_view other = before.substr(begin, end - begin);
    begin = end + 1;
    if (is_comment_or_blank(other)) continue;
    split_fields(other, dialect_.separator, fields_);
    if (static_cast<int>(fields_.size()) == dialect_.fields && !repeats_header(dialect_, fields_))
      usual.add(fields_.back(), dialect_.decimal);
  }
  return read_any(line, at, row, &usual);
}

CsvRow CsvRowReader::read_any(std::string_view line, const CsvPlace& at, int row, const LastCells* usual) {
  if (is_comment_or_blank(line)) {
    if (line.starts_with(kProvenanceComment))
      issues_.add(issue_from_provenance(line.substr(kProvenanceComment.size())));
    return CsvRow::skip;
  }
  if (dialect_.ends_early && without_blanks(line) == kEndOfExport) return CsvRow::skip;
  split_fields(line, dialect_.separator, fields_);
  if (take_header(at)) return CsvRow::skip;
  if (is_other_table_) {
    issues_.add_row(
        at, "other_table",
        [] {
          return "belongs to another table, which has a header with other columns; the rows of that table "
                 "were left out";
        },
        true, Severity::severe);
    return CsvRow::drop;
  }
  CsvRow verdict = usual ? judge_end(line, at, *usual) : CsvRow::keep;
  if (verdict == CsvRow::keep) verdict = judge_length(line, at);
  if (verdict == CsvRow::keep) read_cells(at, row);
  return verdict;
}

/// True when the fields are a header; sets the order of the columns for the rows below.
bool CsvRowReader::take_header(const CsvPlace& at) {
  const std::optional<LaterHeader> header = find_later_header(dialect_, fields_);
  if (!header && !repeats_header(dialect_, fields_)) return false;
  is_other_table_ = header && !header->has_all;
  if (is_other_table_) return true;  // reported for the rows below
  const bool is_same = !header || header->fields == value_fields_;
  issues_.add_row(
      at, is_same ? "header_repeated" : "header_changed",
      [is_same] {
        return is_same ? "repeats the header, as if files were joined; the line was left out"
                       : "follows a header with the columns in another order; from here on, rows were read "
                         "in that order";
      },
      false);
  if (is_same) return true;
  place_columns(header->fields);
  find_places();
  return true;
}

std::string CsvRowReader::field_count(std::string_view line) const {
  return fmt::format("has {} fields, but {} are expected: \"{}\"", fields_.size(), dialect_.fields,
                     shortened(line.substr(0, kQuotedBytes), kLongestName));
}

CsvRow CsvRowReader::judge_end(std::string_view line, const CsvPlace& at, const LastCells& usual) {
  if (static_cast<int>(fields_.size()) < dialect_.fields) {
    issues_.add_row(
        at, "truncated_last_line",
        [&] { return field_count(line) + "; the file was cut here and the row was left out"; }, true);
    return CsvRow::drop;
  }
  if (static_cast<int>(fields_.size()) > dialect_.fields) return CsvRow::keep;
  const std::string cell = shortened(fields_.back(), kLongestName);
  if (!line.ends_with('\r') && usual.is_shorter(fields_.back(), dialect_.decimal)) {
    issues_.add_row(
        at, "truncated_last_line",
        [&] {
          return fmt::format(
              "ends the file without a line break, and its last value \"{}\" is shorter than others of its "
              "column; it may be cut, so the row was left out. If it is complete, end the file with a line "
              "break",
              cell);
        },
        true);
    return CsvRow::drop;
  }
  issues_.add_row(
      at, "last_line_open",
      [&] {
        return fmt::format(
            "ends the file without a line break; its last value \"{}\" has the usual length and was used",
            cell);
      },
      false, Severity::note);
  return CsvRow::keep;
}

CsvRow CsvRowReader::judge_length(std::string_view line, const CsvPlace& at) {
  const int have = static_cast<int>(fields_.size());
  if (have < dialect_.fields) {
    absent_fields_ += dialect_.fields - have;
    if (!dialect_.ends_early)
      issues_.add_row(
          at, "ragged_row",
          [&] { return field_count(line) + "; the lacking fields at its end are treated as missing"; },
          false);
  }
  bool surplus = false;
  for (int i = dialect_.fields; i < have; ++i) surplus = surplus || !fields_[i].empty();
  if (!surplus) return CsvRow::keep;
  issues_.add_row(
      at, "row_too_long",
      [&] {
        return field_count(line) + "; its values cannot be assigned to columns, so the row was left out";
      },
      true);
  return CsvRow::drop;
}

void CsvRowReader::read_cells(const CsvPlace& at, int row) {
  for (int field = 0; field < dialect_.fields; ++field) {
    double* values = field_values_[field];
    if (!values) continue;
    const bool there = field < static_cast<int>(fields_.size());
    const Cell cell = there ? read_cell(fields_[field], dialect_.decimal, dialect_.day_first)
                            : Cell{CellKind::missing, kNan};
    values[row] = cell.value;
    if (cell.kind == CellKind::text && column_of_field_[field] == coded_column_)
      values[row] = text_code(without_blanks(fields_[field]));
    else if (cell.kind == CellKind::text)
      issues_.add_text(at, column_of_field_[field], field, fields_[field]);
  }
  if (dialect_.date_column >= 0) add_date(row);
}

/// Adds the date of the row to its time of day. Rows with dates are never read by read_plain() or
/// read_many().
void CsvRowReader::add_date(int row) {
  double* times = field_values_[value_fields_[dialect_.time_column]];
  const auto date = static_cast<std::size_t>(value_fields_[dialect_.date_column]);
  if (!times) return;
  times[row] +=
      date < fields_.size() ? read_cell(fields_[date], dialect_.decimal, dialect_.day_first).value : kNan;
}

}  // namespace faultline
