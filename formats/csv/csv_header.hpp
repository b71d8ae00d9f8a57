// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "formats/csv/csv_dialect.hpp"
#include "formats/csv/csv_lines.hpp"

namespace faultline {

/// Finds names and units of the columns in the lines above the table or, without a header, in its first rows;
/// sets the columns, header flags and unit of time of `dialect`.
void find_columns(std::span<const CsvLine> above, std::span<const CsvLine> rows, int fields,
                  CsvDialect& dialect);

/// True when these fields of a row repeat the header, as in concatenated files.
bool repeats_header(const CsvDialect& dialect, const std::vector<std::string_view>& fields);

}  // namespace faultline
