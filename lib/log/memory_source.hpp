// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "lib/log/log_source.hpp"

namespace faultline {

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
