// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "formats/byte_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// True for any text; false for binary bytes and UTF-16.
bool looks_like_csv(std::string_view head);

/// Opens a text table in any dialect; see docs/formats-csv.md. Throws Error(input) for a column named twice,
/// too many columns, or a line that is too long.
std::unique_ptr<RawReader> open_csv(std::unique_ptr<ByteSource> bytes);

}  // namespace faultline
