// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

/// Budget of bytes shared by remembered logs; thread-safe.
class LogMemory {
 public:
  explicit LogMemory(std::int64_t budget_bytes = std::int64_t{1} << 30) : free_bytes_(budget_bytes) {}

  /// Reserves bytes; returns false, and reserves nothing, if fewer are free.
  bool take(std::int64_t bytes);
  void give_back(std::int64_t bytes) { free_bytes_ += bytes; }
  std::int64_t free_bytes() const { return free_bytes_; }

 private:
  std::atomic<std::int64_t> free_bytes_;
};

/// A log that is read several times: its segments are kept in memory at the first reading and come from
/// memory after rewind(), even if not all of them had been read by then. A log that does not fit into the
/// memory keeps nothing and is read from its source each time. Segments, identity() and issues() equal those
/// of the source at each moment; as this needs a look at the source between two segments, a source that reads
/// ahead in its own thread must wrap this one, not be wrapped by it.
class RememberedSource : public LogSource {
 public:
  /// `source` is at its first row and has no other reader; it and `memory` outlive this.
  RememberedSource(LogSource& source, LogMemory& memory) : source_(source), memory_(memory) {}
  RememberedSource(const RememberedSource&) = delete;
  RememberedSource& operator=(const RememberedSource&) = delete;
  ~RememberedSource() override { forget(); }

  bool next(Log& segment) override;
  void rewind() override;
  const LogIdentity& identity() const override;
  const Issues& issues() const override;
  double share_read() const override;

 private:
  /// One result of source.next(), with the identity, issues and share read before it.
  struct Answer {
    LogIdentity identity;
    Issues issues;
    double share_read = 0.0;
    bool more = false;
    Log segment;
  };

  bool read(Log& segment);
  void fill_in_hash();
  bool at_end() const { return !answers_.empty() && !answers_.back().more; }
  bool from_memory() const { return position_ < answers_.size(); }
  void forget();

  LogSource& source_;
  LogMemory& memory_;
  std::vector<Answer> answers_;  ///< all results of the source; empty once forgotten
  std::size_t position_ = 0;     ///< results handed out since rewind()
  std::int64_t taken_bytes_ = 0;
  bool forgotten_ = false;
};

/// Logs that are read several times and share one memory: each is parsed once if it fits.
class RememberedLogs {
 public:
  /// `logs` are at their first rows, have no other reader and outlive this.
  explicit RememberedLogs(std::span<LogSource* const> logs) {
    for (LogSource* log : logs) sources_.push_back(&remembered_.emplace_back(*log, memory_));
  }

  std::span<LogSource* const> sources() const { return sources_; }

 private:
  LogMemory memory_;
  std::deque<RememberedSource> remembered_;
  std::vector<LogSource*> sources_;
};

}  // namespace faultline
