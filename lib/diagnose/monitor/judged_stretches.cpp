// SPDX-License-Identifier: MIT
#include "lib/diagnose/monitor/judged_stretches.hpp"

#include <algorithm>
#include <cmath>

#include "lib/log/runs/judged_moment.hpp"

namespace faultline {
namespace {

constexpr double kMissingSteps = 3.0;       // times the step before: rows are missing in a longer one
constexpr std::size_t kMostKept = 100'000;  // stretches, to bound memory if values are missing repeatedly

}  // namespace

void JudgedStretches::note(const UnjudgedStretch& stretch, std::vector<UnjudgedStretch>& stretches) {
  const bool is_long = stretch.is_last || stretch.end_s - stretch.start_s > judged_moment_s(0.0);
  if (is_long && stretches.size() < kMostKept) stretches.push_back(stretch);
}

void JudgedStretches::begin_run(double time_s) {
  for (Joint& joint : joints_) joint = {.judged_s = time_s};
  last_s_ = time_s;
  last_step_s_ = 0.0;
}

void JudgedStretches::end_run(std::vector<UnjudgedStretch>& stretches) const {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = joints_[j];
    if (joint.lacks_position || joint.lacks_torque)
      note({static_cast<int>(j) + 1, joint.judged_s, last_s_, joint.lacks_position, joint.lacks_torque, true},
           stretches);
  }
}

void JudgedStretches::take(const Log& segment, const std::vector<LogRun>& runs) {
  for (int k = 0; k < segment.rows(); ++k) {
    const double t = segment.time[k];
    if (joints_.empty()) {
      joints_.resize(segment.q.size());
      begin_run(t);
    }
    while (run_ + 1 < runs.size() && runs[run_ + 1].is_read && t >= runs[run_ + 1].start_s) {
      end_run(stretches_);
      begin_run(t);
      ++run_;
    }
    const double step_s = t - last_s_;
    if (last_step_s_ > 0.0 && step_s > kMissingSteps * last_step_s_)
      note({0, last_s_, t, false, false}, stretches_);
    last_s_ = t;
    last_step_s_ = step_s;
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      Joint& joint = joints_[j];
      const bool lacks_position = !std::isfinite(segment.q[j][k]);
      const bool lacks_torque = !segment.tau.empty() && !std::isfinite(segment.tau[j][k]);
      if (lacks_position || lacks_torque) {
        joint.lacks_position = joint.lacks_position || lacks_position;
        joint.lacks_torque = joint.lacks_torque || lacks_torque;
        continue;
      }
      if (joint.lacks_position || joint.lacks_torque)
        note({static_cast<int>(j) + 1, joint.judged_s, t, joint.lacks_position, joint.lacks_torque},
             stretches_);
      joint = {.judged_s = t};
    }
  }
}

std::vector<UnjudgedStretch> JudgedStretches::longer_than_a_moment(double sample_period_s) const {
  std::vector<UnjudgedStretch> all = stretches_;
  end_run(all);
  const double period_s = std::isfinite(sample_period_s) ? sample_period_s : 0.0;
  std::erase_if(all, [&](const UnjudgedStretch& s) {
    return s.end_s - s.start_s <= (s.is_last ? judged_moment_at_end_s(period_s) : judged_moment_s(period_s));
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.start_s < b.start_s; });
  return all;
}

}  // namespace faultline
