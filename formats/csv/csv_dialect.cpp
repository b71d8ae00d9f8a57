// SPDX-License-Identifier: MIT
#include "formats/csv/csv_dialect.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <span>
#include <vector>

#include "formats/csv/csv_fields.hpp"
#include "formats/csv/scope_export.hpp"

namespace faultline {
namespace {

constexpr int kDigitsOfADouble = 15;  // that a double always preserves
constexpr int kExponentDigits = 2;    // that the usual libraries write at least

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The parts of a number in text.
struct Digits {
  int significant = 0;  ///< without leading zeros
  int decimals = 0;     ///< after the decimal sign; -1 without one
  int exponent = -1;    ///< -1 without one
  bool ends_in_digit = false;
};

Digits digits_of(std::string_view cell, char decimal) {
  Digits digits{.decimals = -1};
  for (const char c : cell) {
    if (c == 'e' || c == 'E') {
      digits.exponent = 0;
    } else if (c == decimal) {
      digits.decimals = 0;
    } else if (is_digit(c) && digits.exponent >= 0) {
      ++digits.exponent;
    } else if (is_digit(c)) {
      digits.decimals += digits.decimals >= 0;
      digits.significant += c != '0' || digits.significant > 0;
    }
  }
  digits.ends_in_digit = !cell.empty() && is_digit(cell.back());
  return digits;
}

/// True for words such as "true" and "inf", which are read as numbers.
bool is_word(std::string_view cell) { return std::none_of(cell.begin(), cell.end(), is_digit); }

constexpr int kLeastRows = 10;  ///< rows of a sparse table
/// Largest number of columns that all rows of a sparse table have: the time.
constexpr int kCommonColumns = 1;
/// Least share of the rows with the same filled columns for this pattern to count.
constexpr double kLeastShare = 0.1;

using Presence = std::vector<bool>;  ///< by field

bool share_nothing(const Presence& a, const Presence& b, const Presence& always) {
  bool some_a = false, some_b = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (always[i]) continue;
    if (a[i] && b[i]) return false;
    some_a = some_a || a[i];
    some_b = some_b || b[i];
  }
  return some_a && some_b;
}

/// True when the rows look like a table that merges signals of different rates: at most one column, the time,
/// is filled in all rows, and two frequent patterns of filled columns have no other column in common.
bool is_sparse_table(std::span<const CsvLine> lines, int fields, char decimal) {
  std::map<Presence, int> rows_of;
  Presence always(static_cast<std::size_t>(fields), true);
  int rows = 0;
  for (const CsvLine& line : lines) {
    if (!is_data(line, fields)) continue;
    Presence present;
    for (const std::string_view field : line.fields)
      present.push_back(read_cell(field, decimal).kind != CellKind::missing);
    for (std::size_t i = 0; i < always.size(); ++i) always[i] = always[i] && present[i];
    ++rows_of[present];
    ++rows;
  }
  if (rows < kLeastRows || std::count(always.begin(), always.end(), true) > kCommonColumns) return false;
  for (const auto& [a, times_a] : rows_of)
    for (const auto& [b, times_b] : rows_of)
      if (times_a >= kLeastShare * rows && times_b >= kLeastShare * rows && share_nothing(a, b, always))
        return true;
  return false;
}

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

/// Returns the line after the first one with the usual number of fields: a header without data, or the first
/// line of any text.
std::size_t behind_first_line(const std::vector<CsvLine>& lines, int fields) {
  const auto header = std::find_if(lines.begin(), lines.end(), [&](const CsvLine& line) {
    return !line.comment && static_cast<int>(line.fields.size()) == fields;
  });
  return std::min(static_cast<std::size_t>(header - lines.begin()) + 1, lines.size());
}

using LinePlace = std::span<const CsvLine>::iterator;

/// True when the line has a text where `row` has a number: it is of another kind.
bool is_unlike(const CsvLine& line, const CsvLine& row, char decimal) {
  for (std::size_t f = 0; f < line.fields.size(); ++f)
    if (read_cell(line.fields[f], decimal).kind == CellKind::text &&
        read_cell(row.fields[f], decimal).kind == CellKind::number)
      return true;
  return false;
}

/// Returns the first row of the table; the end if there is none. Lines such as "Speed,5" above the header of
/// a table of two columns are none.
LinePlace first_table_row(std::span<const CsvLine> lines, int fields, char decimal) {
  const auto is_row = [&](const CsvLine& line) { return is_data(line, fields); };
  const auto is_header = [&](const CsvLine& line) { return !line.comment && line.texts == fields; };
  LinePlace row = std::find_if(lines.begin(), lines.end(), is_row);
  while (row != lines.end()) {
    const LinePlace header = std::find_if(row, lines.end(), is_header);
    const LinePlace below = std::find_if(header, lines.end(), is_row);
    if (below == lines.end()) break;
    const bool above_only = std::all_of(
        row, header, [&](const CsvLine& line) { return !is_row(line) || is_unlike(line, *below, decimal); });
    if (!above_only) break;
    row = below;
  }
  return row;
}

}  // namespace

void LastCells::add(std::string_view cell, char decimal) {
  const CellKind kind = read_cell(cell, decimal).kind;
  missing_ = missing_ || kind == CellKind::missing;
  texts_ = texts_ || kind == CellKind::text;
  if (kind != CellKind::number || is_word(cell)) return;
  const Digits digits = digits_of(cell, decimal);
  fewest_decimals_ = numbers_ == 0 ? digits.decimals : std::min(fewest_decimals_, digits.decimals);
  most_decimals_ = numbers_ == 0 ? digits.decimals : std::max(most_decimals_, digits.decimals);
  most_digits_ = std::max(most_digits_, digits.significant);
  ++numbers_;
  if (digits.exponent < 0) return;
  fewest_exponent_digits_ =
      exponents_ == 0 ? digits.exponent : std::min(fewest_exponent_digits_, digits.exponent);
  ++exponents_;
}

bool LastCells::is_shorter(std::string_view cell, char decimal) const {
  const CellKind kind = read_cell(cell, decimal).kind;
  if (kind == CellKind::missing) return numbers_ > 0 && !missing_;
  if (kind == CellKind::text) return numbers_ > 0 && !texts_;
  return numbers_ > 0 && !is_word(cell) && has_fewer_digits(cell, decimal);
}

bool LastCells::has_fewer_digits(std::string_view cell, char decimal) const {
  const Digits digits = digits_of(cell, decimal);
  if (!digits.ends_in_digit) return true;
  if (digits.exponent < 0 && exponents_ > 0) return true;
  if (digits.exponent >= 0)
    return digits.exponent < (exponents_ > 0 ? fewest_exponent_digits_ : kExponentDigits);
  const bool fixed = fewest_decimals_ == most_decimals_ && most_decimals_ >= 0;
  if (fixed) return digits.decimals < most_decimals_;
  return digits.significant < std::min(most_digits_, kDigitsOfADouble);
}

CsvDialect find_dialect(std::string_view head) {
  CsvDialect dialect;
  std::vector<CsvLine> lines = lines_of(head);
  choose_separator(lines, dialect);
  if (find_scope_columns(lines, dialect)) return dialect;
  const int fields = usual_fields(lines);
  const std::span<const CsvLine> all(lines);
  const LinePlace row = first_table_row(all, fields, dialect.decimal);
  const bool has_rows = row != all.end();
  const std::size_t data =
      has_rows ? static_cast<std::size_t>(row - all.begin()) : behind_first_line(lines, fields);
  dialect.sparse = is_sparse_table(all.subspan(data), fields, dialect.decimal);
  find_columns(all.first(data), has_rows ? all.subspan(data) : all.last(0), fields, dialect);
  for (const CsvLine& line : all.subspan(data))
    if (is_data(line, fields)) dialect.last_cells.add(line.fields.back(), dialect.decimal);
  dialect.data_begin = data < lines.size() ? lines[data].begin : (lines.empty() ? 0 : lines.back().end);
  dialect.lines_before = static_cast<std::int64_t>(data);
  return dialect;
}

}  // namespace faultline
