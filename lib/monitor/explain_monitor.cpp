// SPDX-License-Identifier: MIT
#include "lib/monitor/explain_monitor.hpp"

#include <algorithm>
#include <cmath>

#include "lib/log/memory_source.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr double kWindow_s = 60.0;
constexpr double kOverlap_s = 20.0;     // of two windows; the middle parts what each decides
constexpr double kLongestGap_s = 2.0;   // that a window spans
constexpr double kFasterBetween = 2.0;  // times the velocity at both ends, between two rows
constexpr double kLeastJump = 0.01;     // rad or m
constexpr double kRowsMissing = 3.0;    // periods between two rows: some were left out
constexpr int kFewestJumps = 2;         // joints: the sensor of one of them may be faulty
constexpr int kFewestRows = 20;         // with position and torque of every joint

/// A row of a log.
struct RowOf {
  const Log& log;
  int row = 0;

  double t() const { return log.time[row]; }
};

/// Whether rows are missing between two rows, and the positions of several joints change further than the
/// velocities of both allow: the log was cut there, or repeats itself.
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

/// By which a healthy day may differ as the robot file says, or by default.
double stated_range(const DayEffect& effect, const Model& model) {
  const NormalRange& normal = model.robot.normal;
  switch (effect.kind) {
    case DayEffectKind::friction:
      return normal.friction;
    case DayEffectKind::torque_gain:
      return normal.torque_constant;
    case DayEffectKind::torque_offset:
      return normal.torque_offset * model.motion.torque_scale[effect.joint - 1];
  }
  return 0.0;
}

/// Rows with position and torque of every joint.
int complete_rows(const Log& log) {
  int out = 0;
  for (int k = 0; k < log.rows(); ++k) {
    const auto has = [k](const JointSignals& signals) {
      return std::all_of(signals.begin(), signals.end(),
                         [k](const std::vector<double>& joint) { return std::isfinite(joint[k]); });
    };
    out += has(log.q) && has(log.tau);
  }
  return out;
}

/// What the rows say; nothing where they are too few.
ExplainedLog explained_rows(const Log& rows, const Model& model) {
  if (complete_rows(rows) < kFewestRows) return {};
  MemorySource source(rows);
  const UniformLog log = uniform_log(source, median_step(rows.time));
  return can_explain(log, model.explain.robot) ? explain_whole_log(log, model.explain) : ExplainedLog{};
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
    if (!is_gap && t - first_s < kWindow_s) continue;
    take_rows(segment, begin, k);
    explain_window(!is_gap);
    begin = k;
  }
  take_rows(segment, begin, segment.rows());
}

void ExplainMonitor::take_rows(const Log& segment, int begin, int end) {
  if (begin == end) return;
  if (window_.rows() == 0)
    window_ = slice(segment, begin, end);
  else
    append(window_, slice(segment, begin, end));
}

void ExplainMonitor::finish() { explain_window(false); }

/// `is_followed`: the log goes on without a gap, so what begins near the end is left to the next window.
void ExplainMonitor::explain_window(bool is_followed) {
  if (window_.rows() == 0) return;
  const double end_s = window_.time.back();
  const double from_s = decided_s_.value_or(window_.time.front());
  const double until_s = is_followed ? end_s - 0.5 * kOverlap_s : end_s;
  const ExplainedLog explained = explained_rows(window_, model_);
  std::vector<Lasting> before;
  std::swap(before, lasting_);
  for (const ExplainedFault& fault : explained.faults) {
    const auto known = std::find_if(before.begin(), before.end(), [&](const Lasting& l) {
      return l.label == fault.label() || (l.label.joint == fault.claim.joint && fault.claim.onset_s < from_s);
    });
    if (known != before.end()) {
      episodes_[known->episode].end_s = std::min(fault.claim.end_s, until_s);
      if (fault.claim.end_s > end_s) lasting_.push_back(*known);
    } else if (fault.claim.onset_s <= until_s && !is_reported(fault.claim)) {
      episodes_.push_back(
          {fault, std::min(fault.claim.end_s, until_s),
           residuals_between(fault.claim.onset_s, fault.claim.onset_s + kEpisodeResiduals_s)});
      if (fault.claim.end_s > end_s) lasting_.push_back({fault.label(), episodes_.size() - 1});
    }
  }
  add_day(explained.day);
  loudness_.resize(std::max(loudness_.size(), explained.loudness.size()), 0.0);
  for (std::size_t j = 0; j < explained.loudness.size(); ++j)
    loudness_[j] = std::max(loudness_[j], explained.loudness[j]);
  if (!is_followed) {
    decided_s_.reset();
    lasting_.clear();
    window_ = {};
    residuals_.clear();
    return;
  }
  decided_s_ = until_s;
  const double kept_s = end_s - kOverlap_s;
  const auto first = std::lower_bound(window_.time.begin(), window_.time.end(), kept_s);
  window_ = slice(window_, static_cast<int>(first - window_.time.begin()), window_.rows());
  while (!residuals_.empty() && residuals_.front().time[residuals_.front().count() - 1] < kept_s)
    residuals_.pop_front();
}

/// Whether an earlier window has reported a fault of this joint that began at about the same time.
bool ExplainMonitor::is_reported(const FaultClaim& claim) const {
  return std::any_of(episodes_.begin(), episodes_.end(), [&](const MonitoredEpisode& episode) {
    return episode.fault.claim.joint == claim.joint &&
           std::abs(episode.onset_s() - claim.onset_s) < kOverlap_s && decided_s_ &&
           claim.onset_s < *decided_s_;
  });
}

void ExplainMonitor::add_day(const std::vector<DayEffect>& day) {
  if (day_.empty()) {
    day_ = day;
    for (DayEffect& sum : day_) sum.value = sum.std = 0.0;
  }
  for (std::size_t i = 0; i < day.size(); ++i) {
    const double weight = 1.0 / (day[i].std * day[i].std);
    day_[i].value += weight * day[i].value;
    day_[i].std += weight;
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
