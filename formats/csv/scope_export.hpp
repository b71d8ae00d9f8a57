// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "formats/csv/csv_dialect.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// True when a text may be an export of TwinCAT Scope, whose head takes many long lines.
bool begins_like_scope_export(std::string_view head);

/// Finds the columns of an export of TwinCAT Scope (docs/formats-csv.md) in the first lines of a file, whose
/// separator is chosen; false, and nothing changed, if they are of no such export. Channels with the same
/// times are one table; those of other sample times become `dialect.others`.
bool find_scope_columns(std::span<const CsvLine> lines, CsvDialect& dialect);

/// Most tables with times of their own in one file.
inline constexpr std::size_t kMostOwnTimes = 8;

/// Returns the rows of `reader` that have a time of their own: rows without time, or with that of the row
/// before, are left out, as the export fills them only because other columns have more rows.
std::unique_ptr<RawReader> rows_of_own_time(std::unique_ptr<RawReader> reader);

}  // namespace faultline
