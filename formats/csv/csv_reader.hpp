// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "formats/byte_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// True for any text; false when the bytes are binary.
bool looks_like_csv(std::string_view head);

/// Opens a text table in whatever dialect it is written; see docs/formats-csv.md. Throws Error(input) for a
/// column named twice or a text that is not UTF-8 (UTF-16).
std::unique_ptr<RawReader> open_csv(std::unique_ptr<ByteSource> bytes);

}  // namespace faultline
