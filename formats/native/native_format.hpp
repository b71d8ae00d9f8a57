// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "formats/byte_source.hpp"
#include "formats/log_writer.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// True when one of the two copies of the header begins in `head`.
bool looks_like_native(std::string_view head);

/// Opens a native log. Damaged chunks are omitted and reported, a cut file is read to its last whole chunk.
/// Throws Error(input) when both copies of the header are damaged, or the file is of another version.
std::unique_ptr<RawReader> open_native(std::unique_ptr<ByteSource> bytes);

/// Creates the native binary format (.flog), see docs/formats-native.md: exact doubles, a checksum per chunk.
std::unique_ptr<LogWriter> create_native(const std::string& path);

}  // namespace faultline
