// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/arrays/array_file.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Returns the reason why the arrays of a file are no log, if none is part of a table with rows.
std::string why_no_table(const std::vector<NamedArray>& arrays);

/// An array that is part of the table, with the columns of the table that it supplies.
struct TableArray {
  std::size_t array = 0;
  bool channel_major = false;
  std::int64_t rows_held = 0;
  std::size_t first_column = 0;  ///< of the table; the others follow
  std::size_t columns = 0;
};

/// The arrays of a file as one table: those that have a value for each row of the log.
struct ArrayTable {
  std::int64_t rows = 0;       ///< according to the shapes
  std::int64_t rows_held = 0;  ///< upper limit of those that the file can hold
  std::vector<RawColumn> columns;
  std::vector<TableArray> arrays;
  int time_column = -1;
  Issues issues;  ///< arrays that do not fit
};

/// Returns the bands that will be read of the arrays of a table.
std::vector<ArrayBand> bands_of(const ArrayTable& table);

/// Forms the table. It has as many rows as the time vector, else the length that most elements share. A
/// matrix has its rows along the dimension of that length, along the first if both have it. Throws
/// Error(input) when there is no array of numbers.
ArrayTable table_of(const std::vector<NamedArray>& arrays, const std::string& path);

}  // namespace faultline
