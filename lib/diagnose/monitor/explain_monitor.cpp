// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/explain_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "lib/diagnose/monitor/log_tally.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr double kOverlap = 1.0 / 3.0;  // share of a window; the middle separates what each window decides
constexpr double kLongestGap_s = 2.0;   // a longer gap ends a window
constexpr double kFasterBetween = 2.0;  // times the velocity at both ends: fastest motion between two rows
constexpr double kLeastJump = 0.01;     // rad or m: smaller position changes are no jump
constexpr double kRowsMissing = 3.0;    // periods: in a longer step between two rows, some are missing
constexpr int kFewestJumps = 2;         // joints: a single one may have a faulty sensor
constexpr int kFewestRows = 20;         // complete rows that a window needs to be explained

/// A row of a log.
struct RowOf {
  const Log& log;
  int row = 0;

  double t() const { return log.time[row]; }
};

/// Whether rows are missing between two rows, and the positions of several joints change more than the
/// velocities at both allow: the log was cut there, or repeats itself.
bool is_break(const RowOf& before, const RowOf& after, double period_s) {
  const double step = after.t() - before.t();
  if (before.log.dq.empty() || step < kRowsMissing * period_s) return false;
  int jumps = 0;
  for (int j = 0; j < before.log.joints(); ++j) {
    const double from = before.log.dq[j][before.row], to = after.log.dq[j][after.row];
    const double farthest = kFasterBetween * std::max(std::abs(from), std::abs(to)) * step + kLeastJump;
    jumps += std::abs(after.log.q[j][after.row] - before.log.q[j][before.row]) > farthest ? 1 : 0;
  }
  return jumps >= kFewestJumps;
}

constexpr double kNormalRipple = 0.04;  // share of a joint's largest torque: ripple of a healthy drive

/// Normal range of an effect by the robot file, or its default: share, N m or N.
double stated_range(const DayEffect& effect, const Model& model) {
  const NormalRange& normal = model.robot.normal;
  switch (effect.kind) {
    case DayEffectKind::friction:
      return normal.friction;
    case DayEffectKind::torque_gain:
      return normal.torque_constant;
    case DayEffectKind::torque_offset:
      return normal.torque_offset * model.motion.torque_scale[effect.joint.index()];
    case DayEffectKind::torque_ripple:
      return kNormalRipple * model.motion.torque_scale[effect.joint.index()];
  }
  return 0.0;
}

}  // namespace

void ExplainMonitor::take(const Log& segment, Residuals residuals, const std::vector<LogRun>& runs) {
  if (residuals.count() > 0) residuals_.push_back(std::move(residuals));
  int begin = 0;
  for (int k = 0; k < segment.rows(); ++k) {
    const double t = segment.time[k];
    bool is_new_run = false;
    while (run_ + 1 < runs.size() && runs[run_ + 1].is_read && t >= runs[run_ + 1].start_s) {
      ++run_;
      is_new_run = true;
    }
    const RowOf now{segment, k}, last = k > begin            ? RowOf{segment, k - 1}
                                        : window_.rows() > 0 ? RowOf{window_, window_.rows() - 1}
                                                             : now;
    const double first_s = window_.rows() > 0 ? window_.time.front() : segment.time[begin];
    const bool is_gap =
        is_new_run || t - last.t() > kLongestGap_s || is_break(last, now, model_.sample_period_s);
    if (!is_gap && t - first_s < model_.explain.window_s) continue;
    if (begin < k) append(window_, slice(segment, begin, k));
    explain_window(!is_gap);
    begin = k;
  }
  if (begin < segment.rows()) append(window_, slice(segment, begin, segment.rows()));
}

void ExplainMonitor::finish() { explain_window(false); }

/// Explains the window. `is_followed`: the log goes on without a gap, and the next window decides on faults
/// that begin near the end.
void ExplainMonitor::explain_window(bool is_followed) {
  if (window_.rows() == 0) return;
  const double overlap_s = kOverlap * model_.explain.window_s;
  const double end_s = window_.time.back(), kept_s = end_s - overlap_s;
  const double until_s = is_followed ? end_s - 0.5 * overlap_s : end_s;
  const ExplainedLog explained = explained_window();
  const std::vector<OngoingFault> unfollowed = follow(explained.followed);
  report_stretches(explained.stretches, until_s);
  for (const ExplainedFault& fault : explained.faults)
    if (fault.claim.onset_s <= until_s) {
      report(fault, unfollowed);
      score_ = larger(score_, score_of(fault));
    }
  if (explained.score.onset_s <= until_s) score_ = larger(score_, explained.score);
  add_day(explained.day);
  judged_s_ += explained.judged_s;
  read_s_ += end_s - window_.time.front();
  noise_level_.resize(std::max(noise_level_.size(), explained.loudness.size()), 0.0);
  for (std::size_t j = 0; j < explained.loudness.size(); ++j)
    noise_level_[j] = std::max(noise_level_[j], explained.loudness[j]);
  if (is_followed) {
    std::erase_if(ongoing_, [&](const OngoingFault& l) { return l.claim.end_s <= kept_s; });
    decided_s_ = until_s;
    keep_from(kept_s);
  } else {
    ongoing_.clear();
    decided_s_.reset();
    window_ = {};
    residuals_.clear();
  }
}

/// Explains the window given the faults that reach into it; finds no new faults if it has too few rows.
ExplainedLog ExplainMonitor::explained_window() const {
  std::vector<FaultClaim> lasting;
  for (const OngoingFault& l : ongoing_)
    if (l.is_handed_on()) lasting.push_back(l.claim);
  const SignalStretches signals = signals_of_window();
  if (complete_rows(window_) >= kFewestRows) {
    const std::optional<UniformLog> log = uniform_rows(window_, median_step(window_.time));
    if (log && can_explain(*log, model_.explain.robot))
      return explain_whole_log(*log, model_.explain, lasting, signals);
  }
  ExplainedLog out;
  out.stretches = judged_stretches(signals.begin, {}, signals.known, nullptr);
  out.followed = std::move(lasting);
  return out;
}

/// Returns the stretches that begin in the window, and the claims of earlier ones that reach into it.
SignalStretches ExplainMonitor::signals_of_window() const {
  const double start_s = window_.time.front(), end_s = window_.time.back();
  const bool is_after_fault = !episodes_.empty() || !stretches_.empty();
  std::vector<JudgedStretch> reach_in;
  for (const JudgedStretch& judged : stretches_)
    if (judged.stretch.end_s >= start_s) reach_in.push_back(judged);
  SignalStretches out{balance_claims(reach_in)};
  for (const SignalStretch& stretch : unjudged_)
    if (stretch.onset_s <= end_s && !(is_after_fault && answers_earlier_fault(stretch)))
      out.begin.push_back(stretch);
  return out;
}

/// Adds the judged stretches that begin before `until_s`, up to which this window decides.
void ExplainMonitor::report_stretches(const std::vector<JudgedStretch>& judged, double until_s) {
  for (const JudgedStretch& each : judged)
    if (each.stretch.onset_s <= until_s) {
      stretches_.push_back(each);
      score_ = larger(score_, score_of(each.fault));
    }
  while (!unjudged_.empty() && unjudged_.front().onset_s <= until_s) unjudged_.pop_front();
}

/// Updates the faults that were handed on to a window by its claims; returns the other lasting ones.
std::vector<ExplainMonitor::OngoingFault> ExplainMonitor::follow(const std::vector<FaultClaim>& followed) {
  std::vector<OngoingFault> unfollowed;
  std::erase_if(ongoing_, [&](const OngoingFault& l) {
    if (!l.is_handed_on()) unfollowed.push_back(l);
    return !l.is_handed_on();
  });
  std::size_t k = 0;
  for (OngoingFault& lasting : ongoing_) {
    lasting.claim = followed[k++];
    episodes_[lasting.episode].end_s = std::min(lasting.claim.end_s, window_.time.back());
  }
  return unfollowed;
}

/// Adds a fault of the window: a further episode, or an unknown one that goes on from the window before.
void ExplainMonitor::report(const ExplainedFault& fault, const std::vector<OngoingFault>& unfollowed) {
  const double end_s = std::min(fault.claim.end_s, window_.time.back());
  if (!unfollowed.empty() && decided_s_ && fault.claim.onset_s < *decided_s_) {
    OngoingFault goes_on = unfollowed.front();
    goes_on.claim.end_s = fault.claim.end_s;
    episodes_[goes_on.episode].end_s = end_s;
    ongoing_.push_back(goes_on);
    return;
  }
  ongoing_.push_back({fault.claim, episodes_.size()});
  episodes_.push_back(
      {fault, end_s, residuals_between(fault.claim.onset_s, fault.claim.onset_s + kEpisodeResiduals_s)});
}

/// Begins the next window with the rows from `time_s` on.
void ExplainMonitor::keep_from(double time_s) {
  const auto first = std::lower_bound(window_.time.begin(), window_.time.end(), time_s);
  window_ = slice(window_, static_cast<int>(first - window_.time.begin()), window_.rows());
  while (!residuals_.empty() && residuals_.front().time[residuals_.front().count() - 1] < time_s)
    residuals_.pop_front();
}

void ExplainMonitor::add_day(const std::vector<DayEffect>& day) {
  for (const DayEffect& effect : day) {
    auto sum = std::ranges::find_if(day_, [&](const DayEffect& other) {
      return other.kind == effect.kind && other.joint == effect.joint;
    });
    if (sum == day_.end()) {
      day_.push_back(effect);
      sum = std::prev(day_.end());
      sum->value = sum->std = 0.0;
    }
    const double weight = 1.0 / (effect.std * effect.std);
    sum->value += weight * effect.value;
    sum->std += weight;
  }
}

std::vector<DayEffect> ExplainMonitor::day() const {
  std::vector<DayEffect> out = day_;
  for (DayEffect& effect : out) {
    effect.value /= effect.std;
    effect.std = 1.0 / std::sqrt(effect.std);
    effect.day_std = std::max(effect.day_std, stated_range(effect, model_) / DayEffect::kStdsInRange);
  }
  return out;
}

std::vector<JointResidual> ExplainMonitor::residuals_between(double from_s, double to_s) const {
  ResidualSummary summary(from_s, to_s);
  for (const Residuals& residuals : residuals_) summary.add(residuals);
  return summary.joints();
}

}  // namespace faultline
