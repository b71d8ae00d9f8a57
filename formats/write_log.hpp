// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "lib/log/log.hpp"

namespace faultline {

/// Writes a log segment by segment; the file appears under its name at commit() only. The first segment
/// decides the channels, all others have the same. How the rows are cut into segments changes no byte of the
/// file.
class LogWriter {
 public:
  virtual ~LogWriter() = default;
  virtual void write(const Log& segment) = 0;
  virtual void commit() = 0;
};

/// A writer for the format that belongs to the extension: ".csv", or ".flog" (native). The path "-" is CSV to
/// standard output. Throws Error(usage) for another extension and Error(output) when it cannot be created.
std::unique_ptr<LogWriter> create_log(const std::string& path);

/// Writes a whole log at once.
void write_log(const std::string& path, const Log& log);

}  // namespace faultline
