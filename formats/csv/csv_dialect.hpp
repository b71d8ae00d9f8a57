// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/csv/last_cells.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

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
  std::string time_note{};        ///< how the unit of the time was derived, if the file does not give it
  LastCells last_cells{};         ///< format of the last cells of the first rows
};

/// Finds the dialect from the first bytes of a file: the separator and decimal sign that make most cells
/// numbers in rows of equal length, then the header above them.
CsvDialect find_dialect(std::string_view head);

}  // namespace faultline
