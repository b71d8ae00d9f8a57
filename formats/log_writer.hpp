// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/log_event.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// Writes a log segment by segment; the file appears under its name at commit() only. The first segment
/// determines the channels, all others have the same. The division of the rows into segments changes no byte
/// of the file.
class LogWriter {
 public:
  virtual ~LogWriter() = default;
  virtual void write(const Log& segment) = 0;
  /// Writes the text of provenance_of() after the rows; call it at most once, after all write().
  virtual void note_provenance(const std::string& provenance) = 0;
  /// Writes events beside the rows; false if the format cannot store them. Call it after all write().
  virtual bool note_events(const std::vector<LogEvent>&) { return false; }
  virtual void commit() = 0;
};

}  // namespace faultline
