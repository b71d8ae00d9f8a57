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

}  // namespace faultline
