// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/csv/csv_fields.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Format of the cells in the last column of a table, to detect that the end of the file may have cut one.
class LastCells {
 public:
  void add(std::string_view cell, char decimal);
  /// True when the cell is shorter than the others and may be the beginning of a longer one: it has fewer
  /// decimals if all have the same number, else fewer digits than the longest (at most 15 count), or an
  /// exponent with fewer digits, or none if others have one. False when no other cell was seen.
  bool is_shorter(std::string_view cell, char decimal) const;

 private:
  bool has_fewer_digits(std::string_view cell, char decimal) const;

  long numbers_ = 0;
  bool missing_ = false, texts_ = false;  ///< such cells were seen
  int fewest_decimals_ = 0, most_decimals_ = 0;
  int most_digits_ = 0;
  long exponents_ = 0;
  int fewest_exponent_digits_ = 0;
};

/// Columns with a time of their own, as TwinCAT Scope exports channels of another sample time: their values
/// in a row belong to the time in the same row of their first column, not to that of the other columns.
struct OwnTimeColumns {
  std::vector<RawColumn> columns;
  std::vector<int> value_fields;
};

/// How a text file writes its table. The separator ' ' means any run of blanks.
struct CsvDialect {
  char separator = ',';
  char decimal = '.';
  std::vector<RawColumn> columns;   ///< named "column1".. when there is no header
  std::size_t data_begin = 0;       ///< byte at which the first data row starts
  std::int64_t lines_before = 0;    ///< lines before it
  std::int64_t preamble_lines = 0;  ///< of these, lines that are neither header, units, comments nor blank
  bool has_header = false;
  bool sparse = false;            ///< each row holds only some of the signals
  bool names_in_rows = false;     ///< the name of each value is in the column before it
  std::vector<int> value_fields;  ///< field of each column
  int fields = 0;                 ///< of a whole row
  bool day_first = false;         ///< in dates such as 03/01/2024
  int time_column = -1;           ///< set only if its cells need more than a factor, see below
  int date_column = -1;           ///< whose date is added to the time of day of time_column; -1 for none
  bool filetime = false;          ///< time_column counts 100 ns since 1601, see seconds_of_filetime()
  bool ends_early = false;        ///< rows may lack fields at their end, which nothing reports
  std::vector<OwnTimeColumns> others{};  ///< not among `columns`
  Issues issues{};                       ///< on the lines above the table and on what was assumed
  LastCells last_cells{};                ///< format of the last cells of the first rows
};

/// Finds the dialect from the first bytes of a file: the separator and decimal sign that make most cells
/// numbers in rows of equal length, then the header above them.
CsvDialect find_dialect(std::string_view head);

/// Finds names and units of the columns in the lines above the table or, without a header, in its first rows;
/// sets the columns, header flags and unit of time of `dialect`.
void find_columns(std::span<const CsvLine> above, std::span<const CsvLine> rows, int fields,
                  CsvDialect& dialect);

/// Finds the time of the table in its first rows: a date and a time of day in two columns, the order of day
/// and month, the unit of a count.
void find_time(std::span<const CsvLine> rows, CsvDialect& dialect);

/// True for a count of 100 ns since 1601, as Windows keeps time (FILETIME), of 1918 to 2108.
bool is_filetime(double count);
/// Returns seconds since 1970; exact to 2 us, as a double holds such a count.
double seconds_of_filetime(double count);

/// True when these fields of a row repeat the header, as in concatenated files.
bool repeats_header(const CsvDialect& dialect, const std::vector<std::string_view>& fields);

}  // namespace faultline
