// SPDX-License-Identifier: MIT
#include "lib/explain/sensor_jumps.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

constexpr double kLeastStep = 6.0;  // standard deviations
constexpr int kApart = 15;          // samples between two jumps
constexpr int kMost = 6;            // jumps of one joint
constexpr int kAround = 14;         // samples on each side that a step is measured over
constexpr double kFewWaves = 0.3;   // decay of the fusion below which the velocity says nothing of steps
constexpr double kHighRate_s = 0.005;
constexpr std::size_t kMostRuns = 3;  // of repeated codes
constexpr int kManyRepeats = 12;      // samples: a healthy position that repeats longer says nothing by it

/// How much each sample is off a smooth motion, and by which size.
VectorXd off_motion(const LogFit& fit, int j) {
  const UniformLog& log = fit.log();
  const RowSetting& setting = fit.model().setting;
  const int n = log.rows() - 1;
  VectorXd out(n);
  const bool from_positions =
      setting.velocity_is_difference || log.dq.rows() == 0 || setting.fusion[j] < kFewWaves;
  for (int k = 0; k < n; ++k) {
    const auto step = [&](int i) {
      const int c = std::clamp(i, 0, n - 1);
      return log.q(c + 1, j) - log.q(c, j);
    };
    out[k] = from_positions ? step(k) - 0.5 * (step(k - 2) + step(k + 2))
                            : step(k) - 0.5 * setting.period_s * (log.dq(k, j) + log.dq(k + 1, j));
  }
  return out;
}

/// Step between samples `at` and `at` + 1, beside a cubic of the time.
std::optional<double> step_size(const UniformLog& log, int j, int at) {
  const int a = std::max(0, at - kAround), b = std::min(log.rows(), at + 2 + kAround);
  const int before = at - a, after = b - at - 1;
  if (before < 5 || after < 5) return std::nullopt;
  bool moved_before = false, moves_after = false;
  for (int k = a + 1; k < at; ++k) moved_before = moved_before || log.q(k, j) != log.q(k - 1, j);
  for (int k = at + 2; k < b; ++k) moves_after = moves_after || log.q(k, j) != log.q(k - 1, j);
  if (!moves_after && moved_before) return std::nullopt;
  Eigen::MatrixXd x(before + after, 5);
  VectorXd y(before + after);
  int row = 0;
  for (int k = a; k < b; ++k) {
    if (k == at) continue;
    const double t = k - at - 0.5;
    x.row(row) << 1.0, t, t * t, t * t * t, t > 0.0 ? 1.0 : 0.0;
    y[row++] = log.q(k, j);
  }
  return x.topRows(row).colPivHouseholderQr().solve(y.head(row))[4];
}

}  // namespace

std::vector<SensorJump> sensor_jumps(const LogFit& fit, int j) {
  const UniformLog& log = fit.log();
  const VectorXd off = off_motion(fit, j);
  std::vector<double> size(off.size());
  for (int k = 0; k < off.size(); ++k) size[k] = std::abs(off[k]);
  const double std = 1.4826 * upper_median(size) + 1e-7;
  std::vector<SensorJump> out;
  for (int n = 0; n < kMost; ++n) {
    const auto top = std::max_element(size.begin(), size.end());
    if (top == size.end() || *top < kLeastStep * std) break;
    const int at = static_cast<int>(top - size.begin());
    for (int k = std::max(0, at - kApart); k < std::min<int>(static_cast<int>(size.size()), at + kApart + 1);
         ++k)
      size[k] = 0.0;
    const std::optional<double> step = step_size(log, j, at);
    if (!step) continue;
    const double jump = fit.model().setting.period_s < kHighRate_s ? *step : off[at];
    if (std::abs(jump) > 3.0 * fit.model().q_noise[j]) out.push_back({log.time_s(at + 1), jump});
  }
  return out;
}

bool repeats_say_something(const BalanceModel& model, int j) {
  return model.longest_repeat[j] < kManyRepeats;
}

std::vector<RepeatedCode> repeated_codes(const LogFit& fit, int j) {
  const UniformLog& log = fit.log();
  const BalanceModel& m = fit.model();
  const double least =
      repeats_say_something(m, j) ? std::max(6, 2 * m.longest_repeat[j]) : 0.1 / m.setting.period_s;
  std::vector<std::pair<int, RepeatedCode>> runs;  // with their samples
  for (int first = 0; first < log.rows();) {
    int next = first + 1;
    while (next < log.rows() && (log.lost[next] || log.q(next, j) == log.q(first, j))) ++next;
    const bool to_the_end = next == log.rows();
    if (next - 1 - first >= least)
      runs.push_back({next - first, {log.time_s(first), to_the_end ? kNeverEnds : log.time_s(next)}});
    first = next;
  }
  std::stable_sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<RepeatedCode> out;
  for (const auto& [samples, run] : runs)
    if (out.size() < kMostRuns) out.push_back(run);
  return out;
}

}  // namespace faultline
