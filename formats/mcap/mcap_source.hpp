// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "formats/byte_source.hpp"
#include "lib/log/raw_reader.hpp"

namespace faultline {

bool looks_like_mcap(std::string_view head);

/// Opens the joint states of an MCAP recording, read from front to back; its index is only checked.
std::unique_ptr<RawReader> open_mcap(std::unique_ptr<ByteSource> bytes);

}  // namespace faultline
