// SPDX-License-Identifier: MIT
#pragma once

#include "lib/log/log_source.hpp"

namespace faultline {

/// A log in memory (simulated, or a stretch of another log), handed out in segments of `segment_rows`.
class MemorySource : public LogSource {
 public:
  explicit MemorySource(Log log, std::string name = "memory", int segment_rows = 4096);

  bool next(Log& segment) override;
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
