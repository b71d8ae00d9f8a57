// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

struct RememberOptions {
  std::int64_t budget_bytes = std::int64_t{1} << 30;  ///< of all logs that share one LogMemory, together
};

/// The bytes that remembered logs may keep among them. Threads may share it.
class LogMemory {
 public:
  explicit LogMemory(const RememberOptions& options = {}) : free_bytes_(options.budget_bytes) {}

  /// False, and nothing is taken, when fewer bytes are left.
  bool take(std::int64_t bytes);
  void give_back(std::int64_t bytes) { free_bytes_ += bytes; }
  std::int64_t free_bytes() const { return free_bytes_; }

 private:
  std::atomic<std::int64_t> free_bytes_;
};

/// A log that is read several times: its segments stay in memory when they are read first, and come from
/// there after rewind(), also when not all of them had been read by then. A log that does not fit into the
/// memory keeps nothing and is read from its source each time. Segments, identity() and issues() are at each
/// moment those that the source would have; because they are looked at between two segments, a source that
/// reads ahead in a thread of its own goes around this one, not into it.
class RememberedSource : public LogSource {
 public:
  /// `source` stands at its first row and is read by nobody else; it and `memory` outlive this.
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
  /// One answer of the source, and what it told of itself before.
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
  std::vector<Answer> answers_;  ///< all that the source gave; empty once forgotten
  std::size_t position_ = 0;     ///< answers handed out since rewind()
  std::int64_t taken_bytes_ = 0;
  bool forgotten_ = false;
};

}  // namespace faultline
