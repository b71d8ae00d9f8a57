// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "formats/csv/csv_dialect.hpp"
#include "formats/csv/csv_lines.hpp"

namespace faultline {

/// Finds names and units of the columns in the lines above the table, else in its first rows, if it has any,
/// and sets what `dialect` says of columns and header.
void find_columns(std::span<const CsvLine> above, std::span<const CsvLine> rows, int fields,
                  CsvDialect& dialect);

/// Whether these fields of a row are the header once more, as where files were joined.
bool repeats_header(const CsvDialect& dialect, const std::vector<std::string_view>& fields);

}  // namespace faultline
