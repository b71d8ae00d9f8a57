// SPDX-License-Identifier: MIT
#include "lib/monitor/evidence_monitor.hpp"

#include <algorithm>

namespace faultline {
namespace {

/// Residuals kept for episodes that are named later: more rows than the detector looks back over.
constexpr std::int64_t kKeptRows = 16384;

}  // namespace

void RecentResiduals::add(Residuals residuals) {
  if (residuals.count() == 0) return;
  const std::int64_t last = residuals.row.back();
  kept_.push_back(std::move(residuals));
  while (kept_.size() > 1 && kept_.front().row.back() < last - kKeptRows) kept_.pop_front();
}

std::vector<JointResidual> RecentResiduals::between(double from_s, double to_s) const {
  ResidualSummary summary(from_s, to_s);
  for (const Residuals& residuals : kept_) summary.add(residuals);
  return summary.joints();
}

EvidenceMonitor::EvidenceMonitor(const Model& model, const MotionModel& motion, const LogNoise& noise)
    : detector_(motion, model.bank, model.evidence, noise) {}

void EvidenceMonitor::take(const Log& segment, Residuals residuals) {
  recent_.add(std::move(residuals));
  detector_.take(segment);
  summarise_new();
}

void EvidenceMonitor::finish() {
  detector_.finish();
  summarise_new();
}

void EvidenceMonitor::summarise_new() {
  const std::vector<EpisodeEvidence>& detected = detector_.episodes();
  for (std::size_t i = residuals_.size(); i < detected.size(); ++i)
    residuals_.push_back(recent_.between(detected[i].onset_s, detected[i].isolated_s));
}

bool EvidenceMonitor::has_alarmed_since(double time_s) const {
  const std::vector<EpisodeEvidence>& episodes = detector_.episodes();
  return std::any_of(episodes.begin(), episodes.end(),
                     [&](const EpisodeEvidence& episode) { return episode.alarm_s >= time_s; });
}

std::vector<MonitoredEpisode> EvidenceMonitor::episodes() const {
  std::vector<MonitoredEpisode> episodes;
  for (std::size_t i = 0; i < residuals_.size(); ++i)
    episodes.push_back({detector_.episodes()[i], residuals_[i]});
  return episodes;
}

}  // namespace faultline
