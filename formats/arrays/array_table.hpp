// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/arrays/array_file.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// An array that is part of the table, with the table's columns that it gives.
struct TableArray {
  std::size_t array = 0;
  bool channel_major = false;
  std::int64_t rows_held = 0;
  std::size_t first_column = 0;  ///< of the table; the others follow
  std::size_t columns = 0;
};

/// The arrays of a file as one table: those that have a value for each row of the log.
struct ArrayTable {
  std::int64_t rows = 0;       ///< that the shapes promise
  std::int64_t rows_held = 0;  ///< that the file can hold at most
  std::vector<RawColumn> columns;
  std::vector<TableArray> arrays;
  int time_column = -1;
  Issues issues;  ///< arrays that do not fit
};

/// What will be read of the arrays of a table.
std::vector<ArrayBand> bands_of(const ArrayTable& table);

/// The rows are as many as the time vector has, else as most elements share. A matrix has the rows along the
/// dimension of that length, along the first when both have it. Throws Error(input) when there is no array of
/// numbers.
ArrayTable table_of(const std::vector<NamedArray>& arrays, const std::string& path);

}  // namespace faultline
