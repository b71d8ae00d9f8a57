// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/diadem/diadem_files.hpp"
#include "formats/diadem/diadem_header.hpp"
#include "lib/core/issue.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Where the values of a column are: value i begins at byte `begin` + i * `stride` of a data file.
struct DiademColumn {
  int file = -1;  ///< in DiademTable::files; -1 for an implicit channel, value i = start + i * step
  DiademType type = DiademType::real64;
  bool in_blocks = false;  ///< `begin` lies in the first row of `stride` bytes
  std::int64_t begin = 0, stride = 0;
  std::int64_t held = 0;           ///< values that the file holds, at most those of the table
  double start = 0.0, step = 1.0;  ///< offset and factor of a stored value
};

/// The channels of a header that share their length and clock, as the columns of a table.
struct DiademTable {
  std::int64_t rows = 0;       ///< according to the header
  std::int64_t rows_held = 0;  ///< those with a value in the data files, and with a time
  std::vector<RawColumn> columns;
  std::vector<DiademColumn> places;  ///< by column
  std::vector<DiademFile> files;     ///< all that the header names and that exist, in its order
  Issues issues;
};

/// Finds the data files in the folder of the header at `path` and forms the table of most channels. Throws
/// Error(input) when a name leads out of that folder, when no data file exists, or when no channel has
/// values.
DiademTable diadem_table(const DiademHeader& header, const std::string& path);

}  // namespace faultline
