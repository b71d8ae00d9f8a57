// SPDX-License-Identifier: MIT
#include "lib/explain/search/sensor_jumps.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

constexpr double kLeastStep = 6.0;     // standard deviations by which a jump differs from the motion
constexpr int kApart = 15;             // samples between two jumps
constexpr int kMost = 6;               // jumps of one joint
constexpr int kAround = 14;            // samples on each side from which a step is estimated
constexpr double kFewWaves = 0.3;      // decay of the fusion: below, the velocity is too noisy to show steps
constexpr double kHighRate_s = 0.005;  // s: below, a cubic of the time beside the step gives its size
constexpr double kMostOfJump = 50.0;   // nats: no fault by itself, for one measurement may be false
constexpr double kTakenBack = 0.3;     // share of a false reading's size by which its opposite may differ
constexpr std::size_t kMostRuns = 3;   // of repeated codes: the longest, and those of the most lost travel
constexpr int kManyRepeats = 12;       // samples: if healthy positions repeat so long, it is no evidence

/// Returns whether the velocity of joint `j` (from 0) does not show steps of its position.
bool is_from_positions(const LogFit& fit, int j) {
  const RowSetting& setting = fit.model().setting;
  return !setting.measures_velocity(j) || fit.log().dq.rows() == 0 || setting.fusion[j] < kFewWaves;
}

/// Returns the deviation of each step between samples from a smooth motion, rad or m.
VectorXd off_motion(const LogFit& fit, int j) {
  const UniformLog& log = fit.log();
  const RowSetting& setting = fit.model().setting;
  const int n = log.rows() - 1;
  VectorXd out(n);
  const bool from_positions = is_from_positions(fit, j);
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

/// Successive samples that repeat one code.
struct RunOfCodes {
  FaultSpan code;
  int samples = 0;
  double lost_travel = 0.0;  ///< of the joint at its speed before them; two samples of it, times their number
};

/// Returns the standard deviation of such deviations by their median, which jumps do not change.
double usual_size(std::vector<double> size) { return 1.4826 * upper_median(std::move(size)) + 1e-7; }

std::vector<double> sizes_of(const VectorXd& off) {
  const VectorXd size = off.cwiseAbs();
  return {size.begin(), size.end()};
}

/// Estimates the step between samples `at` and `at` + 1 beside a cubic in time. Empty near the ends of the
/// log, and if the position moves before the step only.
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
  std::vector<double> size = sizes_of(off);
  const double std = usual_size(size);
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

bool takes_back(double b, double a) { return std::abs(a + b) <= kTakenBack * std::abs(a); }

std::optional<double> taken_back_s(const std::vector<SensorJump>& jumps, const FaultClaim& claim) {
  std::optional<double> first;
  for (const SensorJump& jump : jumps) {
    const double lasts_s = jump.onset_s - claim.onset_s,
                 error = claim.kind == FaultKind::sensor_drift ? claim.size[0] * lasts_s : claim.size[0];
    if (lasts_s > 0.0 && takes_back(jump.size, error) && (!first || jump.onset_s < *first))
      first = jump.onset_s;
  }
  return first;
}

double jump_evidence(const LogFit& fit, const FaultClaim& claim) {
  const int j = claim.joint.index();
  const UniformLog& log = fit.log();
  if (claim.kind != FaultKind::sensor_bias || !claim.velocity_is_true || is_from_positions(fit, j))
    return 0.0;
  const int first = log.first_row(claim.onset_s);  // first sample with the false position
  if (first < 1 || first >= log.rows() || log.lost[first] || log.lost[first - 1]) return 0.0;
  const VectorXd off = off_motion(fit, j);
  // A velocity that changes within a period may move a joint further than its mean does.
  const double bend = 0.5 * log.period_s * (log.dq(first, j) - log.dq(first - 1, j)),
               variance = Eigen::numext::abs2(usual_size(sizes_of(off))) + bend * bend, jump = off[first - 1],
               left = jump - claim.size[0];
  return std::clamp(0.5 * (jump * jump - left * left) / variance, 0.0, kMostOfJump);
}

int repeats(const UniformLog& log, int j, int begin, int end) {
  int out = 0;
  for (int k = std::max(1, begin); k < end; ++k) out += log.q(k, j) == log.q(k - 1, j);
  return out;
}

bool repeats_are_rare(const BalanceModel& model, int j) { return model.longest_repeat[j] < kManyRepeats; }

std::vector<FaultSpan> repeated_codes(const LogFit& fit, int j) {
  const UniformLog& log = fit.log();
  const BalanceModel& m = fit.model();
  const double least =
      repeats_are_rare(m, j) ? std::max(6, 2 * m.longest_repeat[j]) : 0.1 / m.setting.period_s;
  std::vector<RunOfCodes> runs;
  for (int first = 0; first < log.rows();) {
    int next = first + 1;
    while (next < log.rows() && (log.lost[next] || log.q(next, j) == log.q(first, j))) ++next;
    const bool to_the_end = next == log.rows();
    if (next - 1 - first >= least)
      runs.push_back({{log.time_s(first), to_the_end ? kNeverEnds : log.time_s(next)},
                      next - first,
                      std::abs(log.q(first, j) - log.q(std::max(0, first - 2), j)) * (next - first)});
    first = next;
  }
  std::vector<FaultSpan> out;
  const auto add_most = [&](auto RunOfCodes::*criterion) {
    std::ranges::stable_sort(runs, std::ranges::greater{}, criterion);
    const std::size_t most = std::min(runs.size(), kMostRuns);
    for (std::size_t k = 0; k < most; ++k)
      if (std::ranges::find(out, runs[k].code.onset_s, &FaultSpan::onset_s) == out.end())
        out.push_back(runs[k].code);
  };
  add_most(&RunOfCodes::samples);
  add_most(&RunOfCodes::lost_travel);
  return out;
}

}  // namespace faultline
