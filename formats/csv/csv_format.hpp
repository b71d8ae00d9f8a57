// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "formats/byte_source.hpp"
#include "formats/log_writer.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// True for any text; false for binary bytes and UTF-16.
bool looks_like_csv(std::string_view head);

/// Opens a text table in any dialect; see docs/formats-csv.md. Throws Error(input) for a column named twice,
/// too many columns, or a line that is too long.
std::unique_ptr<RawReader> open_csv(std::unique_ptr<ByteSource> bytes);

/// Creates comma-separated text: header `t,q1..,dq1..,tau1..`, further channels after them, the shortest
/// digits that restore the same double, an empty cell for a missing value.
std::unique_ptr<LogWriter> create_csv(const std::string& path);

/// Beginning of the comment line of a text table that contains its provenance.
inline constexpr std::string_view kProvenanceComment = "# faultline provenance: ";

}  // namespace faultline
