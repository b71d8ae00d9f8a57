// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "lib/diagnosis/monitored_episode.hpp"
#include "lib/evidence/watch/episode_detector.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// The latest residuals, forgotten by row so that segment borders do not matter.
class RecentResiduals {
 public:
  void add(Residuals residuals);
  /// Of the predictions with from_s <= time <= to_s that are still kept, a joint each.
  std::vector<JointResidual> between(double from_s, double to_s) const;

 private:
  std::deque<Residuals> kept_;
};

/// Leads the segments of a log through the bank of hypotheses and gives each episode the residuals of its
/// time.
class EvidenceMonitor {
 public:
  /// `motion` is the model's as it suits the log (survey_log()); both outlive this.
  EvidenceMonitor(const Model& model, const MotionModel& motion, const LogNoise& noise);

  void take(const Log& segment, Residuals residuals);
  /// After the last segment.
  void finish();

  std::vector<MonitoredEpisode> episodes() const;
  /// Whether an episode with an alarm at `time_s` or later was named.
  bool has_alarmed_since(double time_s) const;
  /// What the log tells of the robot's slow states; empty without rows.
  std::vector<SlowEstimate> slow_estimates() const { return detector_.slow_estimates(); }
  const std::vector<SlowFault>& slow_faults() const { return detector_.slow_faults(); }
  int rejected_alarms() const { return detector_.rejected_alarms(); }
  double largest_ratio() const { return detector_.largest_ratio(); }

 private:
  void summarise_new();

  EpisodeDetector detector_;
  RecentResiduals recent_;
  std::vector<std::vector<JointResidual>> residuals_;  ///< an entry an episode
};

}  // namespace faultline
