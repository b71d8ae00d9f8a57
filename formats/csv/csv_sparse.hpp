// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "formats/csv/csv_lines.hpp"

namespace faultline {

/// Whether these rows look like a table that merges signals of different rates: some rows hold signals that
/// others lack, and those others hold what the first lack, and all hold the time alone.
bool is_sparse_table(std::span<const CsvLine> lines, int fields, char decimal);

}  // namespace faultline
