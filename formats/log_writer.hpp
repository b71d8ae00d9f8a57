// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline {

/// An event during a log, for formats that store events beside the rows.
struct LogEvent {
  double time_s = 0.0;
  bool grave = false;  ///< an error rather than a remark
  std::string text;
};

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

/// One column of a log to be written. The values belong to the log.
struct WrittenChannel {
  std::string name;
  std::string unit;  ///< empty for canonical channels, which are SI
  const std::vector<double>* values = nullptr;
};

/// Returns the columns of a log in the order t, q1.., dq1.., tau1.., q_ref1.., dq_ref1.., tau_ref1..,
/// tau_meas1.., extra; an extra channel with a canonical name gets the prefix "other_".
std::vector<WrittenChannel> channels_of(const Log& log);

/// Creates a writer for the format that belongs to the extension, such as ".csv" or ".flog" (native). The
/// path "-" is CSV to standard output. Throws Error(usage) for another extension and Error(output) when it
/// cannot be created.
std::unique_ptr<LogWriter> create_log(const std::string& path);

/// Writes a whole log at once.
void write_log(const std::string& path, const Log& log);

}  // namespace faultline
