// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/thin_stretches.hpp"

#include <algorithm>
#include <cmath>

#include "lib/log/runs/judged_moment.hpp"
#include "lib/log/time_axis.hpp"

namespace faultline {
namespace {

constexpr int kPeriodRows = 256;         // first rows, whose median step is the period
constexpr double kLostRowsStep = 3.0;    // periods: rows are missing in a longer step
constexpr std::size_t kMostThin = 1000;  // stretches that are kept, to bound memory

bool lacks(const JointSignals& signals, std::size_t joint, int row) {
  return !signals.empty() && !std::isfinite(signals[joint][row]);
}

}  // namespace

void ThinStretches::take(const Log& segment, const std::vector<LogRun>& runs) {
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
void ThinStretches::begin() {
  has_begun_ = true;
  const auto rows = std::min(head_.rows(), kPeriodRows);
  const double step_s = median_step({head_.time.begin(), head_.time.begin() + rows});
  period_s_ = std::isfinite(step_s) ? step_s : 0.0;
  moment_s_ = judged_moment_s(period_s_);
  width_s_ = judged_window_s(period_s_);
  courses_.resize(head_.q.size() + 1);
  if (rows > 0) begin_run(head_.time.front());
}

void ThinStretches::take_row(const Log& rows, int row, const std::vector<LogRun>& runs) {
  const double t = rows.time[row];
  while (run_ + 1 < runs.size() && runs[run_ + 1].is_read && t >= runs[run_ + 1].start_s) {
    end_run();
    begin_run(t);
    ++run_;
  }
  const bool is_missing_before = t - last_s_ > kLostRowsStep * period_s_;
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

void ThinStretches::begin_run(double time_s) {
  for (Course& course : courses_) {
    course = Course();
    course.judged_s = time_s;
  }
  run_start_s_ = last_s_ = time_s;
}

void ThinStretches::end_run() {
  const double length_s = last_s_ - run_start_s_;
  for (std::size_t c = 0; c < courses_.size(); ++c) {
    if (courses_[c].lacks_position || courses_[c].lacks_torque) judge(c, last_s_ + period_s_, false);
    if (length_s < width_s_) grow(c, std::max(moment_s_, kLeastUnjudgedShare * length_s));
    settle(c);
  }
}

/// Notes that the joint is judged at `time_s`: what was not judged since its last such row becomes a piece.
void ThinStretches::judge(std::size_t course, double time_s, bool is_missing_before) {
  Course& of = courses_[course];
  const bool is_piece = is_missing_before || of.lacks_position || of.lacks_torque;
  const double length_s = time_s - of.judged_s;
  if (is_piece && length_s <= moment_s_)
    add_piece(course, {of.judged_s, time_s, length_s - period_s_, of.lacks_position, of.lacks_torque});
  of.judged_s = time_s;
  of.lacks_position = of.lacks_torque = false;
}

void ThinStretches::add_piece(std::size_t course, const Piece& piece) {
  Course& of = courses_[course];
  while (!of.window.empty() && of.window.front().end_s <= piece.end_s - width_s_) {
    of.window_s -= of.window.front().unjudged_s;
    of.window.pop_front();
  }
  of.window.push_back(piece);
  of.window_s = of.window.size() == 1 ? piece.unjudged_s : of.window_s + piece.unjudged_s;
  grow(course, kLeastUnjudgedShare * width_s_);
}

/// Adds the window to the current stretch if more than `enough_s` of it was not judged.
void ThinStretches::grow(std::size_t course, double enough_s) {
  Course& of = courses_[course];
  if (of.window.empty() || of.window_s <= enough_s) return;
  if (of.window.front().start_s > of.stretch.end_s) settle(course);
  Piece& stretch = of.stretch;
  const bool is_new = stretch.end_s <= stretch.start_s;
  for (const Piece& piece : of.window) {
    if (!is_new && piece.end_s <= stretch.end_s) continue;
    stretch.unjudged_s += piece.unjudged_s;
    stretch.lacks_position = stretch.lacks_position || piece.lacks_position;
    stretch.lacks_torque = stretch.lacks_torque || piece.lacks_torque;
  }
  if (is_new) stretch.start_s = of.window.front().start_s;
  stretch.end_s = of.window.back().end_s;
}

void ThinStretches::settle(std::size_t course) {
  Piece& stretch = courses_[course].stretch;
  const double length_s = stretch.end_s - stretch.start_s;
  if (length_s > 0.0 && found_.size() < kMostThin)
    found_.push_back({.joint = static_cast<int>(course),
                      .start_s = stretch.start_s,
                      .end_s = std::min(stretch.end_s, last_s_),
                      .lacks_position = stretch.lacks_position,
                      .lacks_torque = stretch.lacks_torque,
                      .share = std::min(1.0, stretch.unjudged_s / length_s)});
  stretch = {};
}

/// Returns the stretches found, without those of single joints that overlap one of missing or empty rows.
std::vector<UnjudgedStretch> ThinStretches::without_doubles() const {
  std::vector<UnjudgedStretch> out;
  for (const UnjudgedStretch& each : found_) {
    const bool is_double = std::any_of(found_.begin(), found_.end(), [&](const UnjudgedStretch& rows) {
      return rows.joint == 0 && each.joint != 0 && rows.start_s < each.end_s && each.start_s < rows.end_s;
    });
    if (!is_double) out.push_back(each);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.start_s < b.start_s; });
  return out;
}

std::vector<UnjudgedStretch> ThinStretches::stretches() const {
  ThinStretches ended = *this;
  if (!ended.has_begun_) {
    ended.begin();
    for (int k = 0; k < ended.head_.rows(); ++k) ended.take_row(ended.head_, k, ended.head_runs_);
  }
  if (!ended.courses_.empty()) ended.end_run();
  return ended.without_doubles();
}

}  // namespace faultline
