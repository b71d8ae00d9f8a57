// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/log_writer.hpp"

namespace faultline {

/// Creates a writer for the format that belongs to the extension, such as ".csv" or ".flog" (native). The
/// path "-" is CSV to standard output. Throws Error(usage) for another extension and Error(output) when it
/// cannot be created.
std::unique_ptr<LogWriter> create_log(const std::string& path);

/// Writes a whole log at once.
void write_log(const std::string& path, const Log& log);

}  // namespace faultline
