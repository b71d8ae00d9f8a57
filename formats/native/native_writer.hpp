// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// The native binary format (.flog), see docs/formats-native.md: exact doubles, each chunk with its checksum.
std::unique_ptr<LogWriter> create_native(const std::string& path);

}  // namespace faultline
