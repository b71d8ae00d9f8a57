// SPDX-License-Identifier: MIT
#include "lib/identify/gathered.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/error.hpp"
#include "lib/identify/motion/stretch.hpp"

namespace faultline {
namespace {

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
  const std::vector<double>& gain = gathered.torque_gain;
  const auto visit_true = [&](const Stretch& s) {
    Stretch scaled = s;
    for (int j = 0; j < joints; ++j) scaled.tau.row(j) *= gain[j];
    visit(scaled);
  };
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const LogSurvey& survey = gathered.surveys[i];
    if (gain.empty())
      for_each_stretch(*logs[i], static_cast<int>(i), joints, survey, stride, visit);
    else
      for_each_stretch(*logs[i], static_cast<int>(i), joints, survey, stride, visit_true);
  }
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

}  // namespace

Gathered gather(std::span<LogSource* const> logs, double shortest_window_s, int max_windows,
                const Progress& progress, Identification& id) {
  Gathered out;
  double period_s = 0.0;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    if (progress) progress("reading", static_cast<double>(i) / static_cast<double>(logs.size()));
    out.surveys.push_back(survey_log(*logs[i], id.space.joints()));
    id.issues.merge(logs[i]->issues());
    id.issues.merge(survey_issues(out.surveys.back()));
    period_s = std::max(period_s, out.surveys.back().summary.period_s);
  }
  out.left_out.assign(logs.size(), false);
  out.windows.space = id.space;
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
    id.logs.push_back({from.path,
                       from.sha256,
                       read.rows,
                       out.windows.sets[0].rows_used(static_cast<int>(i)),
                       read.period_s,
                       0.0,
                       {},
                       false});
  }
  const std::size_t windows = out.windows.sets[0].all().size();
  if (windows < kWindows)
    throw Error(
        ErrorCode::input, logs.empty() ? "" : logs[0]->identity().path,
        fmt::format("gives {} usable windows in all; identification needs at least {}: give longer logs of a "
                    "moving robot",
                    windows, kWindows));
  while (out.windows.sets.back().all().size() < kWindows) out.windows.sets.pop_back();
  return out;
}

void gather_again(std::span<LogSource* const> logs, const ParameterSpace& space, const ExtraSetting& setting,
                  Gathered& gathered) {
  WeakSets& windows = gathered.windows;
  windows.space = space;
  windows.extra = setting;
  for (WeakWindows& set : windows.sets) set = set.emptied();
  visit_stretches(logs, gathered, [&](const Stretch& s) { windows.add(s); });
  for (WeakWindows& set : windows.sets) set.leave_out(gathered.left_out);
}

void Gathered::leave_out(const std::vector<int>& logs) {
  for (const int log : logs) left_out[log] = true;
  for (WeakWindows& set : windows.sets) set.leave_out(left_out);
}

void Gathered::leave_out_joints(const std::vector<int>& still) {
  windows.still.assign(windows.space.joints(), false);
  for (const int joint : still) windows.still[joint - 1] = true;
}

std::vector<int> unmoved_joints(const Measurements& measurements, const ParameterSpace& space) {
  std::vector<int> still;
  const Eigen::VectorXd range = measurements.q_high() - measurements.q_low();
  for (int j = 0; j < space.joints(); ++j) {
    const double least = space.chain.geometry[j].kind == AxisKind::revolute ? kLeastTurn : kLeastWay_m;
    if (measurements.still(j) || range[j] < least) still.push_back(j + 1);
  }
  return still;
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
