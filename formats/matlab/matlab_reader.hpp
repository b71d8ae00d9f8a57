// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "formats/byte_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

bool looks_like_matlab(std::string_view head);

/// Opens a MATLAB file of version 5 to 7.3, see docs/formats-matlab.md. Throws Error(input) when it has no
/// matrix of numbers that can be read.
std::unique_ptr<RawReader> open_matlab(std::unique_ptr<ByteSource> bytes);

}  // namespace faultline
