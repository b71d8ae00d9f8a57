// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/relation_monitor.hpp"

#include <algorithm>

namespace faultline {

RelationMonitor::RelationMonitor(const std::vector<SignalRelation>& relations, bool by_tracking) {
  for (const SignalRelation& relation : relations) {
    watches_.emplace_back(relation);
    is_watched_.push_back((relation.kind == RelationKind::tracking) == by_tracking);
  }
}

void RelationMonitor::take(const Log& segment) {
  for (std::size_t i = 0; i < watches_.size(); ++i)
    if (is_watched_[i]) watches_[i].take(segment);
}

void RelationMonitor::finish() {
  for (RelationWatch& watch : watches_) watch.finish();
}

std::vector<RelationEpisode> RelationMonitor::episodes() const {
  std::vector<RelationEpisode> all;
  for (const RelationWatch& watch : watches_)
    all.insert(all.end(), watch.episodes().begin(), watch.episodes().end());
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.onset_s < b.onset_s; });
  return all;
}

std::vector<double> RelationMonitor::judged_s() const {
  std::vector<double> out;
  for (const RelationWatch& watch : watches_) out.push_back(watch.judged_s());
  return out;
}

std::vector<double> RelationMonitor::beyond_s() const {
  std::vector<double> out;
  for (const RelationWatch& watch : watches_) out.push_back(watch.beyond_s());
  return out;
}

}  // namespace faultline
