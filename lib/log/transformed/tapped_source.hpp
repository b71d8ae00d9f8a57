// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <utility>

#include "lib/log/log_source.hpp"

namespace faultline {

/// A log whose segments are shown to somebody on their way.
class TappedSource : public LogSource {
 public:
  using Tap = std::function<void(const Log& segment)>;

  /// `source` is read by nobody else and outlives this. Whoever is shown the segments goes on after a rewind.
  TappedSource(LogSource& source, Tap tap) : source_(source), tap_(std::move(tap)) {}

  bool next(Log& segment) override {
    if (!source_.next(segment)) return false;
    tap_(segment);
    return true;
  }
  void rewind() override { source_.rewind(); }
  const LogIdentity& identity() const override { return source_.identity(); }
  const Issues& issues() const override { return source_.issues(); }
  double share_read() const override { return source_.share_read(); }

 private:
  LogSource& source_;
  Tap tap_;
};

}  // namespace faultline
