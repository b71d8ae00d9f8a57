// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/log/log.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {

/// Identity of a log. `sha256`, `rows_read` and the last time are complete only after the last segment.
struct LogIdentity {
  std::string path;                         ///< as the user gave it
  std::string format;                       ///< such as "csv"
  std::string sha256;                       ///< of the file's bytes; empty for a log that is not a file
  std::int64_t rows_read = 0;               ///< = rows handed out + issues().rows_dropped()
  std::vector<std::string> stated_units{};  ///< channels whose unit the log or the robot file states
  std::vector<LogRun>
      runs{};  ///< of the log's clock; one if it never restarts, empty for a log that is not a file
};

/// The interface through which every stage reads a log: a sequence of segments of bounded size. The time of
/// the rows is finite and strictly increases; the issues list the rows that were dropped to achieve this.
class LogSource {
 public:
  virtual ~LogSource() = default;
  /// Fills `segment`, reusing its storage, and returns true; returns false after the last row. Throws
  /// Error(input) if the file cannot be processed.
  virtual bool next(Log& segment) = 0;
  /// Restarts at the first row, with empty issues.
  virtual void rewind() = 0;
  virtual const LogIdentity& identity() const = 0;
  virtual const Issues& issues() const = 0;
  /// Returns the share of the log handed out so far, 0 to 1, for progress; NaN if unknown.
  virtual double share_read() const { return std::numeric_limits<double>::quiet_NaN(); }
};

/// Returns all remaining rows as one segment; for logs known to be small.
inline Log read_all(LogSource& source) {
  Log all;
  for (Log segment; source.next(segment);) append(all, segment);
  return all;
}

/// A log in memory (simulated, or a stretch of another log), handed out in segments of `segment_rows`.
class MemorySource : public LogSource {
 public:
  explicit MemorySource(Log log, std::string name = "memory", int segment_rows = 4096)
      : log_(std::move(log)), segment_rows_(std::max(segment_rows, 1)) {
    identity_.path = std::move(name);
    identity_.format = "memory";
    identity_.rows_read = log_.rows();
  }

  bool next(Log& segment) override {
    if (position_ >= log_.rows()) return false;
    const int end = std::min(position_ + segment_rows_, log_.rows());
    segment = slice(log_, position_, end);
    position_ = end;
    return true;
  }
  void rewind() override { position_ = 0; }
  const LogIdentity& identity() const override { return identity_; }
  const Issues& issues() const override { return issues_; }
  const Log& log() const { return log_; }

 private:
  Log log_;
  LogIdentity identity_;
  Issues issues_;
  int segment_rows_;
  int position_ = 0;
};

}  // namespace faultline
