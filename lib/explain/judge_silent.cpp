// SPDX-License-Identifier: MIT
#include "lib/explain/judge_silent.hpp"

#include <algorithm>
#include <cmath>

#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/search/sensor_jumps.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDroppedCost = 1.2;  // nats for each row that does not count: an unknown force explains it
constexpr int kSamplesBefore = 20;    // before an onset, that show whether the joint comes to rest
constexpr double kComesToRest = 0.3;  // share of them that repeat a code where the joint comes to rest
constexpr double kJolt = 3.0;         // of the joint's usual torque: that of a halt
constexpr double kRepeated = 0.98;    // share of samples that repeat a code, of a stuck encoder at least
constexpr double kRests = 0.02;  // of the joint's greatest healthy speed (rms): a joint that stands is slower
constexpr double kSettles_s = 0.02;    // s behind the onset, until a locked joint stands
constexpr double kShakes = 0.05;       // share of its evidence that the shaking of a halt explains at most
constexpr double kCoupled = 0.1;       // of a joint's usual torque: what another joint's motion gives
constexpr double kStandingCost = 3.0;  // nats of a joint that does not move

/// Nats by which a joint that is said to be locked moves, but for its spring.
double price_of_motion(const LogFit& fit, int j, const std::vector<int>& late) {
  const BalanceModel& m = fit.model();
  const double compliance = m.compliance(j);
  const VectorXd q = fit.rows().q.col(j)(late), torque = fit.rows().torque.col(j)(late);
  MatrixXd x(q.size(), compliance > 0.0 ? 2 : 1);
  x.col(0).setOnes();
  if (compliance > 0.0) x.col(1) = torque;
  const MatrixXd xx = x.transpose() * x + 1e-12 * MatrixXd::Identity(x.cols(), x.cols());
  const VectorXd off = q - x * xx.ldlt().solve(x.transpose() * q);
  const bool slide = m.rigid.chain.geometry[j].kind == AxisKind::prismatic;
  double std = 3.0 * (std::max(m.q_noise[j] * fit.loudness()[j], 1e-6) *
                          gaussian_kernel(m.setting.kernel_s, m.setting.period_s).norm() +
                      (slide ? 3e-6 : 1e-5));
  if (compliance > 0.0) std += 0.15 * compliance * torque.cwiseAbs().maxCoeff();
  return 0.5 * (off / std).array().square().operator-(1.0).max(0.0).sum();
}

/// What the samples from onset to end say by repeating the position before them.
struct Repeats {
  int samples = 0;
  double share = 0.0;         ///< that repeat the position before
  double share_before = 1.0;  ///< the same before the onset: a joint that comes to rest repeats, too
};

Repeats repeats_in(const LogFit& fit, const FaultClaim& claim) {
  const UniformLog& log = fit.log();
  const int j = claim.joint - 1;
  const int first = log.first_row(claim.onset_s), end = log.first_row(claim.end_s);
  int same = 0, all = 0;
  for (int k = first + 3; k < end; ++k, ++all) same += log.q(k, j) == log.q(k - 1, j);
  int before = 0;
  const int from = std::max(1, first - kSamplesBefore);
  for (int k = from; k < first; ++k) before += log.q(k, j) == log.q(k - 1, j);
  return {end - first, all > 2 ? static_cast<double>(same) / all : 0.0,
          first > from ? static_cast<double>(before) / (first - from) : 1.0};
}

/// Whether the velocity of a joint reads anew from onset to end while the joint stands: a frozen encoder
/// would repeat its velocity, too.
bool velocity_shows_rest(const LogFit& fit, const FaultClaim& claim) {
  const UniformLog& log = fit.log();
  const int j = claim.joint - 1;
  if (log.dq.rows() == 0 || fit.model().setting.velocity_is_difference) return false;
  int samples = 0, same = 0;
  double square = 0.0;
  for (int k = 1; k < log.rows(); ++k) {
    if (log.time_s(k) < claim.onset_s + kSettles_s || log.time_s(k) >= claim.end_s) continue;
    same += log.dq(k, j) == log.dq(k - 1, j);
    square += Eigen::numext::abs2(log.dq(k, j));
    ++samples;
  }
  return samples > 0 && same < kRepeated * samples &&
         square < Eigen::numext::abs2(kRests * fit.model().top_speed[j]) * samples;
}

/// Nats by which the rows of the other joints are explained better with noise as large as they are while a
/// joint is locked: its halt shakes an arm on soft springs, which the model does not follow. At most a share
/// of the evidence of the lock itself: what another fault leaves is no shaking.
double slack_of_halt(const LogFit& fit, const FaultClaim& claim, const Explanation& e, double gain) {
  const LeftWithin left = left_within(fit, claim, e);
  double slack = 0.0;
  for (int j = 0; j < fit.joints(); ++j) {
    const double rows = left.rows[j], square = left.square[j];
    if (rows < 2.0 || square <= 1.0) continue;
    const double louder = rows * (square - 1.0 - elementary::log(square)) - elementary::log(rows);
    slack += 0.5 * std::max(0.0, louder);
  }
  return std::min(slack, std::max(0.0, kShakes * gain));
}

/// Nats of the rows of other joints that a joint moves whose encoder is stuck: its unknown motion makes their
/// torque as uncertain as a share of their usual one, not as their noise.
double price_of_unseen_motion(const LogFit& fit, int j, const StackedMask& dropped) {
  double out = 0.0;
  for (int i = 0; i < fit.joints(); ++i) {
    if (i == j) continue;
    const double torque = kCoupled * fit.model().torque_rms[i];
    for (int k = 0; k < fit.count(); ++k)
      if (dropped[static_cast<std::size_t>(i) * fit.count() + k])
        out += std::max(kDroppedCost, elementary::log(torque / fit.std()(k, i)));
  }
  return out;
}

/// Rows at which the joint must stand still: those that lie within onset and end.
std::vector<int> rows_within(const LogFit& fit, const FaultClaim& claim) {
  const double reach = 3.0 * fit.model().setting.kernel_s + 0.02;
  std::vector<int> out;
  for (int k = 0; k < fit.count(); ++k)
    if (fit.time_s()[k] > claim.onset_s + reach && fit.time_s()[k] < claim.end_s - reach) out.push_back(k);
  return out;
}

/// An impulse on each other joint when a joint halts.
FaultColumns jolt_columns(const LogFit& fit, const FaultClaim& claim) {
  const int rows = fit.count(), n = fit.joints();
  FaultColumns out{StackedColumns::Zero(rows * n, n - 1), VectorXd(n - 1)};
  const double kernel_s = fit.model().setting.kernel_s;
  const VectorXd jolt = fit.time_s().unaryExpr(
      [&](double t) { return elementary::exp(-0.5 * Eigen::numext::abs2((t - claim.onset_s) / kernel_s)); });
  int column = 0;
  for (int i = 0; i < n; ++i) {
    if (i == claim.joint - 1) continue;
    out.column.col(column).segment(i * rows, rows) = jolt;
    out.variance[column++] = Eigen::numext::abs2(kJolt * fit.model().torque_rms[i]);
  }
  return out;
}

}  // namespace

std::optional<FaultHypothesis> judge_silent(const LogFit& fit, const FaultClaim& claim) {
  const BalanceModel& m = fit.model();
  const int j = claim.joint - 1;
  const StackedMask dropped = silent_rows(fit.rows(), m, claim);
  const auto lost = static_cast<double>(std::count(dropped.begin(), dropped.end(), true));
  const auto [samples, same, same_before] = repeats_in(fit, claim);
  const bool telling = repeats_say_something(m, j) && same_before < kComesToRest;
  double price = kDroppedCost * lost;
  if (claim.kind == FaultKind::locked) {
    const std::vector<int> within = rows_within(fit, claim);
    if (within.size() < 5) return std::nullopt;
    price = price_of_motion(fit, j, within) + kStandingCost;
    if (same > kRepeated && telling) price += 2.0 * samples;
  } else if (claim.kind == FaultKind::stuck_encoder) {
    price = kStandingCost + price_of_unseen_motion(fit, j, dropped);
    if (same < kRepeated || samples * m.setting.period_s < (telling ? 0.0 : 0.1)) return std::nullopt;
    if (velocity_shows_rest(fit, claim)) return std::nullopt;
    if (telling) price -= std::min(samples, 500) * elementary::log(1.0 / m.repeat_share[j]);
  }
  const FaultColumns jolt = claim.kind == FaultKind::locked ? jolt_columns(fit, claim) : FaultColumns{};
  Explanation e = fit.explain_with_piece(fit.residual(), jolt, {}, claim.onset_s, dropped);
  e.size.resize(0);
  FaultHypothesis out = hypothesis(fit, claim, std::move(e), price);
  if (claim.kind == FaultKind::locked) out.gain += slack_of_halt(fit, claim, out.fit, out.gain);
  return out;
}

}  // namespace faultline
