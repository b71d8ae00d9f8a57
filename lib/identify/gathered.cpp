// SPDX-License-Identifier: MIT
#include "lib/identify/gathered.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/core/error.hpp"
#include "lib/identify/motion/stretch.hpp"

namespace faultline {
namespace {

constexpr double kStill = 20.0;          // times the noise of q: a joint of smaller range does not move
constexpr double kLeastMotion = 1e-4;    // rad or m
constexpr double kLeastShare = 1e-7;     // of the range: rounding
constexpr double kLeastNoise = 1e-9;     // rad, m, rad/s or m/s
constexpr double kUnknownShare = 0.005;  // of the range: noise, if no log has an estimate

constexpr std::size_t kWindows = 10;                     // fewer are not sufficient
constexpr double kLeastTurn = 2e-3, kLeastWay_m = 2e-4;  // rad, m: a smaller range is stiction giving way
constexpr std::int64_t kMostRows = 400'000;  // rows: of longer logs, only every n-th stretch is used

/// Returns n such that every n-th stretch is used: more rows of long logs would gain little.
int stretch_stride(const std::vector<LogSurvey>& surveys) {
  std::int64_t rows = 0;
  for (const LogSurvey& survey : surveys) rows += survey.summary.rows;
  return static_cast<int>(1 + rows / kMostRows);
}

/// Passes the stretches of all logs to `visit`, torques multiplied by their gains.
void visit_stretches(std::span<LogSource* const> logs, const Gathered& gathered,
                     const std::function<void(const Stretch&)>& visit) {
  const int stride = stretch_stride(gathered.surveys), joints = gathered.windows.space.joints();
  std::vector<double> gain(joints, 1.0);
  for (std::size_t j = 0; j < gathered.torque_gain.size(); ++j) gain[j] *= gathered.torque_gain[j];
  for (int j = 0; gathered.constants && j < joints; ++j) gain[j] *= gathered.constants->constant[j];
  const bool is_scaled = std::any_of(gain.begin(), gain.end(), [](double g) { return g != 1.0; });
  const auto visit_true = [&](const Stretch& s) {
    if (!is_scaled) return visit(s);
    Stretch scaled = s;
    for (int j = 0; j < joints; ++j) scaled.tau.row(j) *= gain[j];
    visit(scaled);
  };
  for (std::size_t i = 0; i < logs.size(); ++i)
    for_each_stretch(*logs[i], static_cast<int>(i), joints, gathered.surveys[i], stride, visit_true);
}

/// Returns the stretch with the torque of joint j delayed by `shift` rows; rows without one are dropped.
Stretch shifted(const Stretch& s, const std::vector<int>& shift) {
  const int first = std::max(0, *std::max_element(shift.begin(), shift.end()));
  const int last = s.rows() + std::min(0, *std::min_element(shift.begin(), shift.end()));
  const int rows = last - first;
  Stretch out = s;
  if (rows < 2) {
    out.time.resize(0);
    return out;
  }
  out.time = s.time.segment(first, rows);
  for (auto m : {&Stretch::q, &Stretch::dq, &Stretch::q_smooth, &Stretch::dq_smooth})
    out.*m = (s.*m).middleCols(first, rows);
  out.outlier = s.outlier.middleCols(first, rows);
  out.tau.resize(s.joints(), rows);
  for (int j = 0; j < s.joints(); ++j) out.tau.row(j) = s.tau.row(j).segment(first - shift[j], rows);
  return out;
}

/// Returns the joints whose position hardly changed in all logs.
std::vector<Joint> unmoved_joints(const Measurements& measurements, const ParameterSpace& space) {
  std::vector<Joint> still;
  const Eigen::VectorXd range = measurements.q_high() - measurements.q_low();
  for (int j = 0; j < space.joints(); ++j) {
    const double least = space.chain.geometry[j].kind == AxisKind::revolute ? kLeastTurn : kLeastWay_m;
    if (measurements.still(j) || range[j] < least) still.push_back(Joint::at(j));
  }
  return still;
}

}  // namespace

void Measurements::add(const Stretch& s) {
  const int n = s.joints();
  if (count_.size() == 0) {
    square_sum_ = count_ = Eigen::VectorXd::Zero(2 * n);
    low_ = Eigen::VectorXd::Constant(2 * n, std::numeric_limits<double>::infinity());
    high_ = -low_;
    first_ = s.q.col(0);
    samples_ = mean_ = square_ = steps_ = step_square_ = Eigen::VectorXd::Zero(n);
  }
  has_dq_ = has_dq_ || s.has_dq;
  add_steps(s);
  for (int c = 0; c < 2 * n; ++c) {
    const auto raw = c < n ? s.q.row(c) : s.dq.row(c - n);
    for (int k = 0; k < s.rows(); ++k) {
      if (c < n && s.outlier(c, k)) continue;
      low_[c] = std::min(low_[c], raw[k]);
      high_[c] = std::max(high_[c], raw[k]);
    }
    if (s.noise[c] <= 0.0) continue;
    square_sum_[c] += s.rows() * s.noise[c] * s.noise[c];
    count_[c] += s.rows();
  }
}

void Measurements::add_steps(const Stretch& s) {
  for (int j = 0; j < s.joints(); ++j)
    for (int k = 0; k < s.rows(); ++k) {
      if (s.outlier(j, k)) continue;
      const double x = s.q(j, k) - first_[j];
      samples_[j] += 1.0;
      mean_[j] += x;
      square_[j] += x * x;
      if (k == 0 || s.outlier(j, k - 1)) continue;
      steps_[j] += 1.0;
      step_square_[j] += (s.q(j, k) - s.q(j, k - 1)) * (s.q(j, k) - s.q(j, k - 1));
    }
}

Eigen::VectorXd Measurements::std() const {
  Eigen::VectorXd out = kUnknownShare * (high_ - low_);
  for (Eigen::Index c = 0; c < out.size(); ++c)
    if (count_[c] > 0.0) out[c] = std::sqrt(square_sum_[c] / count_[c]);
  return out;
}

Eigen::VectorXd Measurements::floor() const { return (kLeastShare * (high_ - low_)).cwiseMax(kLeastNoise); }

bool Measurements::still(int j) const {
  const double jitter = count_[j] > 0.0 ? kStill * std()[j] : 0.0;
  if (high_[j] - low_[j] < std::max(jitter, kLeastMotion)) return true;
  const double mean = mean_[j] / samples_[j], variance = square_[j] / samples_[j] - mean * mean;
  return steps_[j] > 0.0 && step_square_[j] / steps_[j] > variance;  // 2 for noise, near 0 for motion
}

Gathered gather(std::span<LogSource* const> logs, const ParameterSpace& space, double shortest_window_s,
                int max_windows, const Progress& progress) {
  Gathered out;
  double period_s = 0.0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (progress) progress("reading", static_cast<double>(i) / static_cast<double>(logs.size()));
    out.surveys.push_back(survey_log(*logs[i], space.joints()));
    out.issues.merge(logs[i]->issues());
    period_s = std::max(period_s, out.surveys.back().summary.period_s);
  }
  out.left_out.assign(logs.size(), false);
  out.windows.space = space;
  out.windows.shifts = shift_range(period_s);
  for (const double length : window_lengths(shortest_window_s, std::max(period_s, 1e-9)))
    out.windows.sets.emplace_back(length, max_windows);
  visit_stretches(logs, out, [&](const Stretch& s) {
    out.windows.add(s);
    out.measurements.add(s);
  });
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const LogIdentity& from = logs[i]->identity();
    const StretchSummary& read = out.surveys[i].summary;
    out.logs.push_back({.path = from.path,
                        .sha256 = from.sha256,
                        .rows = read.rows,
                        .rows_used = out.windows.sets[0].rows_used(static_cast<int>(i)),
                        .sample_period_s = read.period_s,
                        .fit_r2 = {}});
  }
  const std::size_t windows = out.windows.sets[0].all().size();
  if (windows < kWindows)
    throw Error(
        ErrorCode::input, logs.empty() ? "" : logs[0]->identity().path,
        fmt::format("gives {} usable windows in all; identification needs at least {}: give longer logs of a "
                    "moving robot",
                    windows, kWindows));
  out.windows.still = unmoved_joints(out.measurements, space);
  while (out.windows.sets.back().all().size() < kWindows) out.windows.sets.pop_back();
  return out;
}

Gathered gather_again(std::span<LogSource* const> logs, const ParameterSpace& space,
                      const ExtraSetting& setting, Gathered gathered) {
  WeakSets& windows = gathered.windows;
  windows.space = space;
  windows.extra = setting;
  for (WeakWindows& set : windows.sets) set = set.emptied();
  visit_stretches(logs, gathered, [&](const Stretch& s) { windows.add(s); });
  for (WeakWindows& set : windows.sets) set.leave_out(gathered.left_out);
  return gathered;
}

Gathered with_motor_constants(std::span<LogSource* const> logs, Gathered gathered) {
  gathered.constants = motor_constants(gathered.windows);
  if (!gathered.constants) return gathered;
  const ParameterSpace space = gathered.windows.space;
  const ExtraSetting setting = gathered.windows.extra;
  return gather_again(logs, space, setting, std::move(gathered));
}

void Gathered::leave_out(const std::vector<int>& more) {
  for (const int log : more) left_out[log] = true;
  for (WeakWindows& set : windows.sets) set.leave_out(left_out);
}

std::vector<Excerpt> gather_excerpts(std::span<LogSource* const> logs, const Gathered& gathered,
                                     const std::vector<int>& shift, Excerpts excerpts) {
  visit_stretches(logs, gathered, [&](const Stretch& s) {
    if (gathered.left_out[s.log]) return;
    const Stretch acting = shifted(s, shift);
    if (acting.rows() > 0) excerpts.add(acting);
  });
  return excerpts.take();
}

}  // namespace faultline
