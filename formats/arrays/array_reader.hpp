// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/arrays/array_file.hpp"
#include "formats/byte_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

/// Opens the arrays of a file as the columns of a log. A value that cannot be read is NaN; a row without its
/// time, or without any value, is omitted. Both are reported as issues. The file is open only while rows are
/// read. Throws Error(input) when it holds no array, cannot be read at all, or is a pipe.
std::unique_ptr<RawReader> read_arrays(std::unique_ptr<ByteSource> bytes, const std::string& format,
                                       OpenArrays open);

}  // namespace faultline
