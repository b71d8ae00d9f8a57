// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_run.hpp"

namespace faultline {

/// What is known of a log besides its rows. `sha256`, `rows_read` and the last time are complete only after
/// the last segment was taken.
struct LogIdentity {
  std::string path;            ///< as the user gave it
  std::string format;          ///< such as "csv"
  std::string sha256;          ///< of the file's bytes; empty for a log that is no file
  std::int64_t rows_read = 0;  ///< = rows handed out + issues().rows_dropped()
  std::vector<LogRun>
      runs{};  ///< of the log's clock; one where it never restarts, empty for a log that is no file
};

/// The door through which every stage sees a log: a sequence of segments of bounded size. Rows that come out
/// have finite, strictly increasing time; what had to be dropped for that is in the issues.
class LogSource {
 public:
  virtual ~LogSource() = default;
  /// Fills `segment` in its own storage and returns true, or returns false after the last row. Throws
  /// Error(input) when the file cannot be processed.
  virtual bool next(Log& segment) = 0;
  /// Starts again at the first row, with issues empty.
  virtual void rewind() = 0;
  virtual const LogIdentity& identity() const = 0;
  virtual const Issues& issues() const = 0;
  /// Share of the log handed out so far, 0 to 1, for progress; NaN when unknown.
  virtual double share_read() const { return std::numeric_limits<double>::quiet_NaN(); }
};

/// The whole rest of a log as one segment; for logs known to be small.
Log read_all(LogSource& source);

}  // namespace faultline
