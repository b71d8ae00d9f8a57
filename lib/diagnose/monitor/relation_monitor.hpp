// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "lib/log/log.hpp"
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

}  // namespace faultline
