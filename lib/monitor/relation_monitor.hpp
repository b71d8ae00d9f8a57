// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "lib/log/log_source.hpp"
#include "lib/residual/relation/relation_watch.hpp"

namespace faultline {

/// Leads the segments of a log through the second residuals of a model: those with torque or, where a log has
/// none, tracking.
class RelationMonitor {
 public:
  /// `relations` outlive this.
  RelationMonitor(const std::vector<SignalRelation>& relations, bool by_tracking);

  void take(const Log& segment);
  /// After the last segment.
  void finish();

  /// By onset.
  std::vector<RelationEpisode> episodes() const;
  /// By relation: for how long the log could be judged, s; 0 for those of the other sort.
  std::vector<double> judged_s() const;
  /// By relation: for how long its inputs were beyond all that was learned, s.
  std::vector<double> beyond_s() const;

 private:
  std::deque<RelationWatch> watches_;
  std::vector<char> is_watched_;
};

/// A log whose segments pass a monitor on their way.
class WatchedSource : public LogSource {
 public:
  /// Both outlive this; `source` is read by nobody else.
  WatchedSource(LogSource& source, RelationMonitor& monitor) : source_(source), monitor_(monitor) {}

  bool next(Log& segment) override {
    if (!source_.next(segment)) return false;
    monitor_.take(segment);
    return true;
  }
  /// The monitor goes on: a log is rewound before it is watched.
  void rewind() override { source_.rewind(); }
  const LogIdentity& identity() const override { return source_.identity(); }
  const Issues& issues() const override { return source_.issues(); }
  double share_read() const override { return source_.share_read(); }

 private:
  LogSource& source_;
  RelationMonitor& monitor_;
};

}  // namespace faultline
