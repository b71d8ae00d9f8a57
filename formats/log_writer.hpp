// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/log_event.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Writes a log segment by segment; the file appears under its name at commit() only. The first segment
/// decides the channels, all others have the same. How the rows are cut into segments changes no byte of the
/// file.
class LogWriter {
 public:
  virtual ~LogWriter() = default;
  virtual void write(const Log& segment) = 0;
  /// Puts what provenance_of() says behind the rows; to be called once at most, after all write().
  virtual void note_provenance(const std::string& provenance) = 0;
  /// Puts events beside the rows; false where the format has no place for them. After all write().
  virtual bool note_events(const std::vector<LogEvent>&) { return false; }
  virtual void commit() = 0;
};

}  // namespace faultline
