// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// Creates the native binary format (.flog), see docs/formats-native.md: exact doubles, a checksum per chunk.
std::unique_ptr<LogWriter> create_native(const std::string& path);

}  // namespace faultline
