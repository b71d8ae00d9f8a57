// SPDX-License-Identifier: MIT
#include "lib/pipeline/listen.hpp"

#include <cmath>
#include <deque>

#include "lib/core/error.hpp"
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

void check_channels(const Log& segment, const LogSource& log, const Model& model) {
  const int joints = model.robot.joints();
  if (segment.joints() != joints)
    throw Error(ErrorCode::input, log.identity().path,
                "is a log of another robot: it has " + std::to_string(segment.joints()) +
                    " joints, the model \"" + model.name + "\" has " + std::to_string(joints));
  if (static_cast<int>(segment.tau.size()) != joints)
    throw Error(
        ErrorCode::input, log.identity().path,
        "has no torque (tau1..tau" + std::to_string(joints) +
            "), without which no fault can be judged; map the columns in [log.columns] of the robot file");
}

void count_rows(const Log& segment, Heard& heard) {
  if (heard.rows == 0 && segment.rows() > 0) heard.start_s = segment.time.front();
  if (segment.rows() > 0) heard.end_s = segment.time.back();
  heard.has_velocity = !segment.dq.empty();
  heard.rows += segment.rows();
  for (int k = 0; k < segment.rows(); ++k) {
    bool complete = true;
    for (int j = 0; j < segment.joints(); ++j)
      complete = complete && std::isfinite(segment.q[j][k]) && std::isfinite(segment.tau[j][k]);
    heard.judgeable_rows += complete;
  }
}

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
    check_channels(segment, log, model);
    count_rows(segment, heard);
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
