// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/unjudged_time.hpp"

#include <algorithm>
#include <cmath>

#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr int kPeriodRows = 256;                              // first rows, whose median step is the period
constexpr double kLostRowsStep = 3.0;                         // periods: rows are missing in a longer step
constexpr std::size_t kMostLong = 100'000, kMostThin = 1000;  // stretches that are kept, to bound memory

bool lacks(const JointSignals& signals, std::size_t joint, int row) {
  return !signals.empty() && !std::isfinite(signals[joint][row]);
}

/// The joint of a course; none for that of the rows.
Joint joint_of(std::size_t course) { return Joint::at(static_cast<int>(course) - 1); }

/// Returns the thin stretches without those of single joints that overlap one of missing or empty rows.
std::vector<UnjudgedStretch> without_doubles(const std::vector<UnjudgedStretch>& thin) {
  std::vector<UnjudgedStretch> out;
  for (const UnjudgedStretch& each : thin) {
    const bool is_double = std::any_of(thin.begin(), thin.end(), [&](const UnjudgedStretch& rows) {
      return rows.joint.is_none() && !each.joint.is_none() && rows.start_s < each.end_s &&
             each.start_s < rows.end_s;
    });
    if (!is_double) out.push_back(each);
  }
  return out;
}

}  // namespace

void UnjudgedTime::take(const Log& segment, const std::vector<LogRun>& runs) {
  if (has_begun_) {
    for (int k = 0; k < segment.rows(); ++k) take_row(segment, k, runs);
    return;
  }
  append(head_, segment);
  head_runs_ = runs;
  if (head_.rows() < kPeriodRows) return;
  begin();
  for (int k = 0; k < head_.rows(); ++k) take_row(head_, k, runs);
  head_ = {};
}

/// Estimates the period from the first rows, and begins the first run.
void UnjudgedTime::begin() {
  has_begun_ = true;
  const auto rows = std::min(head_.rows(), kPeriodRows);
  const double step_s = median_step({head_.time.begin(), head_.time.begin() + rows});
  period_s_ = std::isfinite(step_s) ? step_s : 0.0;
  moment_s_ = judged_moment_s(period_s_);
  width_s_ = judged_window_s(period_s_);
  courses_.resize(head_.q.size() + 1);
  if (rows > 0) begin_run(head_.time.front());
}

void UnjudgedTime::take_row(const Log& rows, int row, const std::vector<LogRun>& runs) {
  const double t = rows.time[row];
  while (run_ + 1 < runs.size() && runs[run_ + 1].is_read && t >= runs[run_ + 1].start_s) {
    end_run();
    begin_run(t);
    ++run_;
  }
  const bool is_missing_before = t - last_s_ > kLostRowsStep * period_s_;
  if (t - last_s_ > moment_s_ && long_.size() < kMostLong)
    long_.push_back({Joint(), last_s_, t, false, false});
  bool is_empty = true;
  for (std::size_t j = 0; j < rows.q.size(); ++j) {
    Course& joint = courses_[j + 1];
    const bool lacks_position = lacks(rows.q, j, row), lacks_torque = lacks(rows.tau, j, row);
    is_empty = is_empty && lacks_position;
    joint.lacks_position = joint.lacks_position || lacks_position;
    joint.lacks_torque = joint.lacks_torque || lacks_torque;
    if (!lacks_position && !lacks_torque) judge(j + 1, t, is_missing_before);
  }
  if (is_empty)
    courses_[0].lacks_position = true;
  else
    judge(0, t, is_missing_before);
  last_s_ = t;
}

void UnjudgedTime::begin_run(double time_s) {
  for (Course& course : courses_) {
    course = Course();
    course.judged_s = time_s;
  }
  run_start_s_ = last_s_ = time_s;
}

void UnjudgedTime::end_run() {
  const double length_s = last_s_ - run_start_s_;
  for (std::size_t c = 0; c < courses_.size(); ++c) {
    if (courses_[c].lacks_values()) {
      add_piece(c, last_s_ + period_s_);
      if (last_s_ - courses_[c].judged_s > judged_moment_at_end_s(period_s_)) note_long(c, last_s_);
    }
    if (length_s < width_s_) grow(c, std::max(moment_s_, kLeastUnjudgedShare * length_s));
    settle(c);
  }
}

/// Takes note that the joint is judged at `time_s`: it was not since its last judged row.
void UnjudgedTime::judge(std::size_t course, double time_s, bool is_missing_before) {
  Course& of = courses_[course];
  if (of.lacks_values() || is_missing_before) add_piece(course, time_s);
  if (of.lacks_values() && time_s - of.judged_s > moment_s_) note_long(course, time_s);
  of.judged_s = time_s;
  of.lacks_position = of.lacks_torque = false;
}

/// Adds the stretch since the last judged row. Rows without any position are listed by joint.
void UnjudgedTime::note_long(std::size_t course, double end_s) {
  const Course& of = courses_[course];
  if (course > 0 && long_.size() < kMostLong)
    long_.push_back({joint_of(course), of.judged_s, end_s, of.lacks_position, of.lacks_torque});
}

/// Adds the time since the last judged row to the window, unless it is a long stretch.
void UnjudgedTime::add_piece(std::size_t course, double end_s) {
  Course& of = courses_[course];
  const double length_s = end_s - of.judged_s;
  if (length_s > moment_s_) return;
  while (!of.window.empty() && of.window.front().end_s <= end_s - width_s_) {
    of.window_s -= of.window.front().unjudged_s;
    of.window.pop_front();
  }
  const double unjudged_s = length_s - period_s_;
  of.window.push_back({of.judged_s, end_s, unjudged_s, of.lacks_position, of.lacks_torque});
  of.window_s = of.window.size() == 1 ? unjudged_s : of.window_s + unjudged_s;
  grow(course, kLeastUnjudgedShare * width_s_);
}

/// Adds the window to the current stretch if more than `enough_s` of it was not judged.
void UnjudgedTime::grow(std::size_t course, double enough_s) {
  Course& of = courses_[course];
  if (of.window.empty() || of.window_s <= enough_s) return;
  if (of.window.front().start_s > of.thin.end_s) settle(course);
  Piece& thin = of.thin;
  const bool is_new = thin.end_s <= thin.start_s;
  for (const Piece& piece : of.window) {
    if (!is_new && piece.end_s <= thin.end_s) continue;
    thin.unjudged_s += piece.unjudged_s;
    thin.lacks_position = thin.lacks_position || piece.lacks_position;
    thin.lacks_torque = thin.lacks_torque || piece.lacks_torque;
  }
  if (is_new) thin.start_s = of.window.front().start_s;
  thin.end_s = of.window.back().end_s;
}

void UnjudgedTime::settle(std::size_t course) {
  Piece& thin = courses_[course].thin;
  const double length_s = thin.end_s - thin.start_s;
  if (length_s > 0.0 && thin_.size() < kMostThin)
    thin_.push_back({.joint = joint_of(course),
                     .start_s = thin.start_s,
                     .end_s = std::min(thin.end_s, last_s_),
                     .lacks_position = thin.lacks_position,
                     .lacks_torque = thin.lacks_torque,
                     .share = std::min(1.0, thin.unjudged_s / length_s)});
  thin = {};
}

std::vector<UnjudgedStretch> UnjudgedTime::stretches() const {
  UnjudgedTime ended = *this;
  if (!ended.has_begun_) {
    ended.begin();
    for (int k = 0; k < ended.head_.rows(); ++k) ended.take_row(ended.head_, k, ended.head_runs_);
  }
  if (!ended.courses_.empty()) ended.end_run();
  std::vector<UnjudgedStretch> out = std::move(ended.long_);
  for (const UnjudgedStretch& thin : without_doubles(ended.thin_)) out.push_back(thin);
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.start_s < b.start_s; });
  return out;
}

}  // namespace faultline
