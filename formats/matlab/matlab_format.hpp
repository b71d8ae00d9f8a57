// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "formats/byte_source.hpp"
#include "formats/log_writer.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

bool looks_like_matlab(std::string_view head);

/// Opens a MATLAB file of version 5 to 7.3, see docs/formats-matlab.md. Throws Error(input) when it has no
/// matrix of numbers that can be read.
std::unique_ptr<RawReader> open_matlab(std::unique_ptr<ByteSource> bytes);

/// Creates a MATLAB file of version 5 (as save -v6 does), see docs/formats-matlab.md. The whole log is kept
/// in memory until commit(), which throws Error(output) when an array is larger than such a file may hold.
std::unique_ptr<LogWriter> create_matlab(const std::string& path);

}  // namespace faultline
