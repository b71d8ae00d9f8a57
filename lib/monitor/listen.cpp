// SPDX-License-Identifier: MIT
#include "lib/monitor/listen.hpp"

#include <cmath>
#include <deque>

#include "lib/evidence/listener.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

/// Residuals kept for episodes that are judged later: more rows than a judgement looks back over.
constexpr std::int64_t kKeptRows = 16384;

/// The latest residuals, forgotten by row so that segment borders do not matter.
class RecentResiduals {
 public:
  void add(Residuals residuals) {
    if (residuals.count() == 0) return;
    const std::int64_t last = residuals.row.back();
    kept_.push_back(std::move(residuals));
    while (kept_.size() > 1 && kept_.front().row.back() < last - kKeptRows) kept_.pop_front();
  }

  std::vector<JointResidual> between(double from_s, double to_s) const {
    ResidualSummary summary(from_s, to_s);
    for (const Residuals& residuals : kept_) summary.add(residuals);
    return summary.joints();
  }

 private:
  std::deque<Residuals> kept_;
};

}  // namespace

Heard listen(LogSource& log, const Model& model) {
  Heard heard;
  Listener listener(model.motion, model.bank, model.evidence);
  ResidualState residual_state;
  ResidualSummary whole;
  RecentResiduals recent;
  auto summarise_new_episodes = [&] {
    while (heard.episode_residuals.size() < heard.episodes.size()) {
      const EpisodeEvidence& episode = heard.episodes[heard.episode_residuals.size()];
      heard.episode_residuals.push_back(recent.between(episode.onset_s, episode.judged_s));
    }
  };
  for (Log segment; log.next(segment);) {
    heard.tally.take(segment, log, model);
    Residuals residuals = compute_residuals(model.residual, segment, residual_state);
    whole.add(residuals);
    recent.add(std::move(residuals));
    listener.listen(segment, heard.episodes);
    summarise_new_episodes();
  }
  listener.finish(heard.episodes);
  summarise_new_episodes();
  heard.residuals = whole.joints();
  heard.rejected_alarms = listener.rejected_alarms();
  heard.largest_ratio = listener.largest_ratio();
  return heard;
}

}  // namespace faultline
