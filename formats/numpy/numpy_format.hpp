// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "formats/byte_source.hpp"
#include "formats/log_writer.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

bool looks_like_npy(std::string_view head);
bool looks_like_npz(std::string_view head);

/// Open an array file of numpy, see docs/formats-numpy.md. Throw Error(input) when it has no array of numbers
/// that can be read.
std::unique_ptr<RawReader> open_npy(std::unique_ptr<ByteSource> bytes);
std::unique_ptr<RawReader> open_npz(std::unique_ptr<ByteSource> bytes);

/// Creates an .npz file for numpy.load(), see docs/formats-numpy.md. The log is in memory until commit().
std::unique_ptr<LogWriter> create_npz(const std::string& path);

}  // namespace faultline
