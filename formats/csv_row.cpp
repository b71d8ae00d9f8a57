// SPDX-License-Identifier: MIT
#include "formats/csv_row.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <limits>

#include "formats/csv_fields.hpp"
#include "formats/csv_header.hpp"

namespace faultline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

CsvRowReader::CsvRowReader(const CsvDialect& dialect, CsvIssues& issues)
    : dialect_(dialect), issues_(issues) {
  want(std::vector<bool>(dialect_.columns.size(), true));
}

void CsvRowReader::want(const std::vector<bool>& columns) {
  column_of_field_.assign(dialect_.fields, -1);
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i]) column_of_field_[dialect_.value_fields[i]] = static_cast<int>(i);
}

void CsvRowReader::begin_block(RawBlock& block, int max_rows) {
  block.columns.resize(dialect_.columns.size());
  field_values_.assign(dialect_.fields, nullptr);
  for (int field = 0; field < dialect_.fields; ++field) {
    const int column = column_of_field_[field];
    if (column < 0) continue;
    block.columns[column].resize(max_rows);
    field_values_[field] = block.columns[column].data();
  }
}

const char* CsvRowReader::read_plain(const char* p, const char* end, int row) {
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

CsvRow CsvRowReader::read_any(std::string_view line, bool open_end, const CsvPlace& at, int row) {
  if (is_comment_or_blank(line)) return CsvRow::skip;
  split_fields(line, dialect_.separator, fields_);
  if (repeats_header(dialect_, fields_)) {
    issues_.add_row(at, "header_repeated",
                    "repeats the header; the line was left out, as where files were joined", false);
    return CsvRow::skip;
  }
  const CsvRow verdict = judge_length(line, open_end, at);
  if (verdict == CsvRow::keep) read_cells(at, row);
  return verdict;
}

CsvRow CsvRowReader::judge_length(std::string_view line, bool open_end, const CsvPlace& at) {
  const int have = static_cast<int>(fields_.size());
  const std::string start = fmt::format("has {} fields where {} are expected: \"{}\"", have, dialect_.fields,
                                        std::string(line.substr(0, 60)));
  if (have < dialect_.fields && open_end) {
    issues_.add_row(at, "truncated_last_line", start + "; the file was cut here and the row was left out",
                    true);
    return CsvRow::drop;
  }
  if (have < dialect_.fields)
    issues_.add_row(at, "ragged_row", start + "; the fields at its end are taken as missing", false);
  bool surplus = false;
  for (int i = dialect_.fields; i < have; ++i) surplus = surplus || !fields_[i].empty();
  if (!surplus) return CsvRow::keep;
  issues_.add_row(at, "row_too_long", start + "; which value is which is not sure, so the row was left out",
                  true);
  return CsvRow::drop;
}

void CsvRowReader::read_cells(const CsvPlace& at, int row) {
  for (int field = 0; field < dialect_.fields; ++field) {
    double* values = field_values_[field];
    if (!values) continue;
    const bool there = field < static_cast<int>(fields_.size());
    const Cell cell = there ? read_cell(fields_[field], dialect_.decimal) : Cell{CellKind::missing, kNan};
    values[row] = cell.value;
    if (cell.kind == CellKind::text) issues_.add_text(at, column_of_field_[field], field, fields_[field]);
  }
}

}  // namespace faultline
