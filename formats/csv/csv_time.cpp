// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "formats/csv/clock_text.hpp"
#include "formats/csv/csv_dialect.hpp"
#include "formats/csv/csv_fields.hpp"
#include "lib/core/text.hpp"
#include "lib/log/channel_names.hpp"
#include "lib/log/columns/counted_time.hpp"

namespace faultline {
namespace {

/// Ticks of 100 ns from 1601 to 1970, and those of 1918 and of 2108: counts of ns since 1970 are larger,
/// those of us smaller.
constexpr double kFiletimeOf1970 = 116444736e9, kLeastFiletime = 1e17, kMostFiletime = 1.6e17;
constexpr double kFiletimeTick_s = 1e-7;

/// What the cells of a column are in the first rows.
struct ClockCells {
  int dates = 0, times_of_day = 0, both = 0, others = 0;
  int day_first = 0, month_first = 0, either = 0;  ///< dates by the order in which they can be read

  /// True when most of them are: a row may be damaged, or below a header in another order.
  bool are(int ClockCells::*kind) const { return 2 * this->*kind > dates + times_of_day + both + others; }
};

void add_cell(std::string_view cell, ClockCells& cells) {
  auto clock = read_clock(cell, false);
  if (!clock) clock = read_clock(cell, true);
  if (!clock) {
    ++cells.others;
    return;
  }
  cells.dates += clock->kind == ClockKind::date;
  cells.times_of_day += clock->kind == ClockKind::time_of_day;
  cells.both += clock->kind == ClockKind::date_and_time;
  cells.day_first += clock->order == DateOrder::day_first;
  cells.month_first += clock->order == DateOrder::month_first;
  cells.either += clock->order == DateOrder::either;
}

std::string_view clock_cell_of(const CsvLine& row, std::size_t column, const CsvDialect& dialect) {
  return row.fields[static_cast<std::size_t>(dialect.value_fields[column])];
}

/// Returns what the cells of each column are; missing ones do not count.
std::vector<ClockCells> clock_cells(std::span<const CsvLine> rows, const CsvDialect& dialect) {
  std::vector<ClockCells> columns(dialect.columns.size());
  for (const CsvLine& row : rows) {
    if (!is_data(row, dialect.fields)) continue;
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (const auto cell = clock_cell_of(row, i, dialect);
          read_cell(cell, dialect.decimal).kind != CellKind::missing)
        add_cell(cell, columns[i]);
  }
  return columns;
}

/// Decides whether dates such as 03/01/2024 have the day first, by a number above 12 among them.
void find_date_order(const std::vector<ClockCells>& columns, CsvDialect& dialect) {
  int day_first = 0, month_first = 0, either = 0;
  for (const ClockCells& cells : columns) {
    day_first += cells.day_first;
    month_first += cells.month_first;
    either += cells.either;
  }
  dialect.day_first = day_first > month_first;
  if (either > 0 && day_first + month_first == 0)
    dialect.issues.add(
        {"date_order_assumed", "t", Severity::note,
         "dates such as 03/01/2024 do not show whether the day or the month is first; they were read with the "
         "month first. That matters for the date itself and for a log that passes midnight only; dates such as "
         "2024-03-01 and 01.03.2024 are certain"});
}

/// Returns the column whose cells are all of this kind: `named` if it is one, else the only one; -1 for none.
int clock_column_of(const std::vector<ClockCells>& columns, int ClockCells::*kind, int named) {
  if (named >= 0 && columns[static_cast<std::size_t>(named)].are(kind)) return named;
  int only = -1;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!columns[i].are(kind)) continue;
    if (only >= 0) return -1;
    only = static_cast<int>(i);
  }
  return only;
}

/// Finds a time that is written as date and time of day, in one or two columns, under any name. A column of
/// numbers with the name of a time is preferred. True when there is one.
bool find_clock(const std::vector<ClockCells>& columns, int named, CsvDialect& dialect) {
  const int date = clock_column_of(columns, &ClockCells::dates, named);
  const int of_day = clock_column_of(columns, &ClockCells::times_of_day, named);
  const int both = clock_column_of(columns, &ClockCells::both, named);
  int time = named;
  if (date >= 0 && of_day >= 0 && (named < 0 || named == date || named == of_day)) {
    time = of_day;
    dialect.time_column = of_day;
    dialect.date_column = date;
  } else if (named < 0) {
    time = both >= 0 ? both : of_day;
  }
  if (time < 0) return false;
  const ClockCells& cells = columns[static_cast<std::size_t>(time)];
  if (cells.times_of_day + cells.both == 0) return false;
  if (time != named) dialect.columns[static_cast<std::size_t>(time)].meaning = Channel{};
  return true;
}

std::vector<double> cell_values_of(std::span<const CsvLine> rows, std::size_t column,
                                   const CsvDialect& dialect) {
  std::vector<double> values;
  for (const CsvLine& row : rows)
    if (is_data(row, dialect.fields))
      values.push_back(
          read_cell(clock_cell_of(row, column, dialect), dialect.decimal, dialect.day_first).value);
  return values;
}

/// Sets the unit of a time without unit to the one that its steps suggest.
void find_time_unit(std::span<const CsvLine> rows, std::size_t time, CsvDialect& dialect) {
  const std::vector<double> times = cell_values_of(rows, time, dialect);
  if (!times.empty() && is_filetime(times.front())) {
    dialect.time_column = static_cast<int>(time);
    dialect.filetime = true;
    return;
  }
  std::vector<NamedValues> moving;
  for (std::size_t i = 0; i < dialect.columns.size(); ++i)
    if (const auto quantity = parse_name(dialect.columns[i].name).quantity;
        quantity == Quantity::q || quantity == Quantity::dq)
      moving.push_back({dialect.columns[i].name, cell_values_of(rows, i, dialect)});
  const CountedTime counted = counted_time(times, moving);
  dialect.columns[time].unit = counted.unit;
  dialect.columns[time].unit_assumed = !counted.why.empty();
  if (!counted.why.empty()) dialect.issues.add({"time_unit_assumed", "t", Severity::note, counted.why});
}

}  // namespace

bool is_filetime(double count) { return count > kLeastFiletime && count < kMostFiletime; }

double seconds_of_filetime(double count) { return kFiletimeTick_s * (count - kFiletimeOf1970); }

void find_time(std::span<const CsvLine> rows, CsvDialect& dialect) {
  std::vector<std::string> names;
  for (const RawColumn& column : dialect.columns) names.push_back(column.name);
  const int named = find_time_column(names);
  const std::vector<ClockCells> cells = clock_cells(rows, dialect);
  find_date_order(cells, dialect);
  if (find_clock(cells, named, dialect)) return;  // in seconds
  if (named >= 0 && dialect.columns[static_cast<std::size_t>(named)].unit.empty())
    find_time_unit(rows, static_cast<std::size_t>(named), dialect);
}

}  // namespace faultline
