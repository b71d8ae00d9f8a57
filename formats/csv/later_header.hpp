// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "formats/csv/csv_dialect.hpp"

namespace faultline {

/// A header that stands among the rows of a table, as where files were joined.
struct LaterHeader {
  std::vector<int> fields;  ///< of each column of the table; -1 for a column that it does not have
  bool has_all = false;     ///< the same columns with the same units, in whatever order, and no others
};

/// Nullopt for a line that is no header: of its cells, all are text, and half of the table's columns at least
/// are among them.
std::optional<LaterHeader> find_later_header(const CsvDialect& dialect,
                                             const std::vector<std::string_view>& fields);

}  // namespace faultline
