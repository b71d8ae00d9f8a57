// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>

#include "lib/log/log_source.hpp"

namespace faultline {

/// Base of a log that is made from another one and has its identity, issues and progress. The source is at
/// its first row and has no other reader.
class ChangedSource : public LogSource {
 public:
  /// `source` outlives this.
  explicit ChangedSource(LogSource& source) : source_(source) {}
  explicit ChangedSource(std::unique_ptr<LogSource> source) : owned_(std::move(source)), source_(*owned_) {}

  void rewind() override { source_.rewind(); }
  const LogIdentity& identity() const override { return source_.identity(); }
  const Issues& issues() const override { return source_.issues(); }
  double share_read() const override { return source_.share_read(); }

 protected:
  std::unique_ptr<LogSource> owned_;  ///< null if it belongs to the caller
  LogSource& source_;
};

/// A log that a stage makes from another one. A `Stage` holds all that one pass over the log needs to know,
/// so that a copy of a new one begins again; its next(source, segment) is LogSource::next(). Its issues(), if
/// it has any, follow those of the source.
template <typename Stage>
class StagedSource : public ChangedSource {
 public:
  explicit StagedSource(LogSource& source, Stage stage = {})
      : ChangedSource(source), fresh_(std::move(stage)), stage_(fresh_) {}
  explicit StagedSource(std::unique_ptr<LogSource> source, Stage stage = {})
      : ChangedSource(std::move(source)), fresh_(std::move(stage)), stage_(fresh_) {}

  bool next(Log& segment) override { return stage_.next(source_, segment); }
  void rewind() override {
    source_.rewind();
    stage_ = fresh_;
  }
  const Issues& issues() const override {
    if constexpr (requires { stage_.issues(); }) {
      issues_ = source_.issues();
      issues_.merge(stage_.issues());
      return issues_;
    } else {
      return source_.issues();
    }
  }
  const Stage& stage() const { return stage_; }

 private:
  Stage fresh_, stage_;
  mutable Issues issues_;  ///< of source and stage, gathered on demand
};

}  // namespace faultline
