// SPDX-License-Identifier: MIT
#include "formats/csv/csv_dialect.hpp"

#include <algorithm>

#include "formats/csv/csv_header.hpp"
#include "formats/csv/csv_lines.hpp"
#include "formats/csv/csv_sparse.hpp"

namespace faultline {
namespace {

double score(std::vector<CsvLine>& lines, char separator, char decimal) {
  for (CsvLine& line : lines)
    if (!line.comment) count_cells(line, separator, decimal);
  const int fields = usual_fields(lines);
  double sum = 0.0;
  int all_fields = 0;
  for (const CsvLine& line : lines) {
    if (line.comment) continue;
    all_fields += static_cast<int>(line.fields.size());
    if (is_data(line, fields)) sum += line.numbers - 0.5 * line.texts;
  }
  return sum > 0.0 ? sum : 1e-6 * all_fields;
}

void choose_separator(std::vector<CsvLine>& lines, CsvDialect& dialect) {
  double best = -1.0;
  for (const char separator : {',', ';', '\t', '|', ' '}) {
    for (const char decimal : {'.', ','}) {
      if (separator == decimal) continue;
      const double now = score(lines, separator, decimal);
      if (now > best) best = now, dialect.separator = separator, dialect.decimal = decimal;
    }
  }
  score(lines, dialect.separator, dialect.decimal);
}

/// The line behind a header without data, or behind the first line of any text: the first one with the usual
/// number of fields.
std::size_t behind_first_line(const std::vector<CsvLine>& lines, int fields) {
  const auto header = std::find_if(lines.begin(), lines.end(), [&](const CsvLine& line) {
    return !line.comment && static_cast<int>(line.fields.size()) == fields;
  });
  return std::min(static_cast<std::size_t>(header - lines.begin()) + 1, lines.size());
}

}  // namespace

CsvDialect find_dialect(std::string_view head) {
  CsvDialect dialect;
  std::vector<CsvLine> lines = lines_of(head);
  choose_separator(lines, dialect);
  const int fields = usual_fields(lines);
  const auto row =
      std::find_if(lines.begin(), lines.end(), [&](const CsvLine& line) { return is_data(line, fields); });
  const bool has_rows = row != lines.end();
  const std::size_t data =
      has_rows ? static_cast<std::size_t>(row - lines.begin()) : behind_first_line(lines, fields);
  const std::span<const CsvLine> all(lines);
  dialect.sparse = is_sparse_table(all.subspan(data), fields, dialect.decimal);
  find_columns(all.first(data), has_rows ? all.subspan(data) : all.last(0), fields, dialect);
  for (const CsvLine& line : all.subspan(data))
    if (is_data(line, fields)) dialect.last_cells.add(line.fields.back(), dialect.decimal);
  dialect.data_begin = data < lines.size() ? lines[data].begin : (lines.empty() ? 0 : lines.back().end);
  dialect.lines_before = static_cast<std::int64_t>(data);
  return dialect;
}

}  // namespace faultline
