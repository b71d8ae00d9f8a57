// SPDX-License-Identifier: MIT
#include "lib/explain/judge/judge.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/free_form.hpp"
#include "lib/explain/judge/judge_force.hpp"
#include "lib/explain/search/sensor_jumps.hpp"
#include "lib/explain/search/standstill.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kClippedDoubt = 0.02, kPriceOfClipping = 100.0;  // of the torque withheld (std); nats: rare
constexpr double kLeastClip = 0.04;  // share of the greatest torque: a joint that gets less swings freely
constexpr double kSurely = 4.0;      // standard deviations within which remaining friction may be negative

constexpr int kSamplesBefore = 20;       // samples before an onset that show whether the joint comes to rest
constexpr double kComesToRest = 0.3;     // share of them that repeat a code if the joint comes to rest
constexpr std::size_t kFewestStill = 5;  // rows in which a joint must stand still
constexpr double kJolt = 3.0;            // times the joint's usual torque: that of a halt
constexpr double kRests = 0.02;      // of the joint's greatest healthy speed: a joint at rest is slower (rms)
constexpr double kSettles_s = 0.02;  // s after the onset until a locked joint stands still
constexpr double kStillVelocity = 0.1;  // of the noise of the velocity: a smaller change is none
constexpr double kShakes = 0.05;        // share of the evidence of a lock that its shaking adds, at most
constexpr double kCoupled = 0.1;  // share of a joint's usual torque that the motion of another joint gives

/// Returns the nats by which the positions of the rows `late` speak against a joint (from 0) at rest that
/// yields like this.
double price_of_motion(const LogFit& fit, int j, const std::vector<int>& late, const Yielding& yielding) {
  const BalanceModel& m = fit.model();
  const VectorXd q = fit.rows().q.col(j)(late), load = yielding.load(late);
  MatrixXd x(q.size(), yielding.compliance > 0.0 ? 2 : 1);
  x.col(0).setOnes();
  if (yielding.compliance > 0.0) x.col(1) = load;
  const MatrixXd xx = x.transpose() * x + 1e-12 * MatrixXd::Identity(x.cols(), x.cols());
  const VectorXd off = q - x * xx.ldlt().solve(x.transpose() * q);
  const bool slide = m.rigid.chain.geometry[j].kind == AxisKind::prismatic;
  double std = 3.0 * (std::max(m.q_noise[j] * fit.loudness()[j], 1e-6) *
                          gaussian_kernel(m.setting.kernel_s, m.setting.period_s).norm() +
                      (slide ? 3e-6 : 1e-5));
  std += 0.15 * yielding.compliance * load.cwiseAbs().maxCoeff();
  return 0.5 * (off / std).array().square().operator-(1.0).max(0.0).sum();
}

/// Repeated positions in the samples from onset to end.
struct Repeats {
  int samples = 0;
  double share = 0.0;         ///< share that repeats the position before
  double share_before = 1.0;  ///< the same before the onset: a joint that comes to rest repeats, too
};

Repeats repeats_in(const LogFit& fit, const FaultClaim& claim) {
  const UniformLog& log = fit.log();
  const int j = claim.joint.index();
  const int first = log.first_row(claim.onset_s), end = log.first_row(claim.end_s);
  const int within = first + 3, before = std::max(1, first - kSamplesBefore);
  const auto share = [&](int from, int to) {
    return static_cast<double>(repeats(log, j, from, to)) / (to - from);
  };
  return {end - first, end - within > 2 ? share(within, end) : 0.0,
          first > before ? share(before, first) : 1.0};
}

/// Returns whether the measured velocity of a joint changes by its noise from onset to end and shows rest: a
/// stuck encoder would repeat its velocity, too, or let it fade in a filter.
bool velocity_shows_rest(const LogFit& fit, const FaultClaim& claim) {
  const UniformLog& log = fit.log();
  const int j = claim.joint.index();
  if (log.dq.rows() == 0 || !fit.model().setting.measures_velocity(j)) return false;
  const double still = kStillVelocity * fit.model().dq_noise[j];
  int samples = 0, same = 0;
  double square = 0.0;
  for (int k = 1; k < log.rows(); ++k) {
    if (log.time_s(k) < claim.onset_s + kSettles_s || log.time_s(k) >= claim.end_s) continue;
    same += std::abs(log.dq(k, j) - log.dq(k - 1, j)) <= still;
    square += Eigen::numext::abs2(log.dq(k, j));
    ++samples;
  }
  return samples > 0 && same < kStuckShare * samples &&
         square < Eigen::numext::abs2(kRests * fit.model().top_speed[j]) * samples;
}

/// Returns the nats by which noise as large as their residuals explains the rows of the other joints better
/// while a joint is locked: its halt shakes an arm on soft springs, which the model does not describe. At
/// most a share of the evidence of the lock: residuals of another fault are no shaking.
double slack_of_halt(const LogFit& fit, const FaultClaim& claim, const Explanation& e, double gain) {
  const ResidualWithin left = residual_within(fit, claim, e);
  double slack = 0.0;
  for (int j = 0; j < fit.joints(); ++j) {
    const double rows = left.rows[j], square = left.square[j];
    if (rows < 2.0 || square <= 1.0) continue;
    const double louder = rows * (square - 1.0 - elementary::log(square)) - elementary::log(rows);
    slack += 0.5 * std::max(0.0, louder);
  }
  return std::min(slack, std::max(0.0, kShakes * gain));
}

/// Returns the nats of the rows of other joints that a joint with a stuck encoder moves: its unknown motion
/// makes their torque as uncertain as a share of their usual one, not as their noise.
double price_of_unseen_motion(const LogFit& fit, int j, const StackedMask& dropped) {
  double out = 0.0;
  for (int i = 0; i < fit.joints(); ++i) {
    if (i == j) continue;
    const double torque = kCoupled * fit.model().torque_rms[i];
    for (int k = 0; k < fit.count(); ++k)
      if (dropped[static_cast<std::size_t>(i) * fit.count() + k])
        out += std::max(kForcedRow, elementary::log(torque / fit.std()(k, i)));
  }
  return out;
}

/// Returns the rows within onset and end, at which the joint must stand still.
std::vector<int> rows_within(const LogFit& fit, const FaultClaim& claim) {
  const double reach = 3.0 * fit.model().setting.kernel_s + 0.02;
  std::vector<int> out;
  for (int k = 0; k < fit.count(); ++k)
    if (fit.time_s()[k] > claim.onset_s + reach && fit.time_s()[k] < claim.end_s - reach) out.push_back(k);
  return out;
}

/// Returns the nats by which the position of a joint follows its torque as a lock that yields lets it, and as
/// a joint without torque does not.
double price_of_following(const LogFit& fit, const FaultClaim& claim) {
  const int j = claim.joint.index();
  const std::vector<int> within = rows_within(fit, claim);
  if (within.size() < kFewestStill) return 0.0;
  return std::max(0.0, price_of_motion(fit, j, within, yielding_of_gear(fit, j)) -
                           price_of_motion(fit, j, within, yielding_of_lock(fit, j, within)));
}

/// Returns the columns of an impulse on each other joint when a joint halts.
FaultColumns jolt_columns(const LogFit& fit, const FaultClaim& claim) {
  const int rows = fit.count(), n = fit.joints();
  FaultColumns out{StackedColumns::Zero(rows * n, n - 1), VectorXd(n - 1)};
  const double kernel_s = fit.model().setting.kernel_s;
  const VectorXd jolt = fit.time_s().unaryExpr(
      [&](double t) { return elementary::exp(-0.5 * Eigen::numext::abs2((t - claim.onset_s) / kernel_s)); });
  int column = 0;
  for (int i = 0; i < n; ++i) {
    if (i == claim.joint.index()) continue;
    out.column.col(column).segment(i * rows, rows) = jolt;
    out.variance[column++] = Eigen::numext::abs2(kJolt * fit.model().torque_rms[i]);
  }
  return out;
}

/// Judges a hypothesis with silent rows: a lock, a stuck encoder, an unknown force. Empty if too little data
/// shows that the joint stands still or that its encoder is stuck.
std::optional<FaultHypothesis> judge_silent(const LogFit& fit, const FaultClaim& claim) {
  const BalanceModel& m = fit.model();
  const int j = claim.joint.index();
  const StackedMask dropped = silent_rows(fit.rows(), m, claim);
  const auto lost = static_cast<double>(std::count(dropped.begin(), dropped.end(), true));
  const auto [samples, same, same_before] = repeats_in(fit, claim);
  const bool telling = repeats_are_rare(m, j) && same_before < kComesToRest;
  double price = kForcedRow * lost;
  if (claim.kind == FaultKind::locked) {
    const std::vector<int> within = rows_within(fit, claim);
    if (within.size() < kFewestStill) return std::nullopt;
    price = price_of_motion(fit, j, within, yielding_of_lock(fit, j, within)) + kStillJoint;
    if (same > kStuckShare && telling) price += kRepeatedReading * samples;
  } else if (claim.kind == FaultKind::stuck_encoder) {
    price = kStillJoint + price_of_unseen_motion(fit, j, dropped);
    if (same < kStuckShare || samples * m.setting.period_s < (telling ? 0.0 : 0.1)) return std::nullopt;
    if (velocity_shows_rest(fit, claim)) return std::nullopt;
    if (telling) price -= std::min(samples, kMostRepeats) * elementary::log(1.0 / m.repeat_share[j]);
  }
  const FaultColumns jolt = claim.kind == FaultKind::locked ? jolt_columns(fit, claim) : FaultColumns{};
  Explanation e = fit.explain_with_piece(fit.residual(), jolt, {}, claim.onset_s, dropped);
  e.size.resize(0);
  FaultHypothesis out = hypothesis(fit, claim, std::move(e), price);
  if (claim.kind == FaultKind::locked) out.gain += slack_of_halt(fit, claim, out.fit, out.gain);
  return out;
}

/// Returns the nats of a size that the fault does not have.
double price_of_size(const LogFit& fit, const LinearFault& fault, const FaultClaim& claim,
                     const Explanation& e) {
  const VectorXd& size = e.size;
  const FaultKind kind = fault.kind;
  const int j = claim.joint.index();
  if (kind == FaultKind::torque_loss)
    return kNoSuchSize * std::max(0.0, -size[0]) + kBeyondLoss * std::max(0.0, size[0] - kMostLoss);
  if (kind == FaultKind::torque_sensor_error) return 0.0;
  if (kind == FaultKind::payload_change) {
    if (size[0] < 0.0 && fit.has_piece() && claim.joint == fit.last_joint()) return kNoSuchSize;
    return kBeyondLoss * std::max(0.0, -size[0] / fault.carried_kg - 1.0);
  }
  const ColumnLayout layout = fit.model().layout();
  const VectorXd& theta = fit.model().theta;
  const auto seconds = [&](double time_s) { return claim.grows ? time_s - claim.onset_s : 1.0; };
  const VectorXd surely =
      (size + kSurely * e.size_covariance.diagonal().cwiseSqrt()) *  // remaining friction must not drive
      seconds(std::min(claim.end_s, fit.time_s()[fit.count() - 1]));
  if (surely[0] < -theta[layout.viscous(j)] || surely[1] < -theta[layout.coulomb(j)]) return kNoSuchSize;
  double power = 0.0;  // that the friction takes
  int rows = 0;
  for (int k = 0; k < fit.count(); ++k) {
    if (fit.time_s()[k] <= claim.onset_s || fit.time_s()[k] >= claim.end_s) continue;
    const double v = fit.rows().dq(k, j);
    power += (size[0] * v + size[1] * elementary::tanh(v / fit.model().setting.friction_width[j])) * v *
             seconds(fit.time_s()[k]);
    ++rows;
  }
  return rows < 3 || power <= 0.0 ? kNoSuchSize : 0.0;
}

FaultHypothesis judge_linear(const LogFit& fit, const LinearFault& fault, FaultClaim claim) {
  const FaultColumns columns = fit.between(fault.columns, claim.onset_s, claim.end_s);
  Explanation e = fit.explain_with_piece(fit.residual(), columns, fault.starts, claim.onset_s);
  claim.kind = fault.kind;
  claim.grows = fault.columns.grow;
  if (fault.kind == FaultKind::torque_loss && e.size[0] > kFreeShare) claim.kind = FaultKind::free_swinging;
  const double shrinking = price_of_shrinking(fit, claim, e);
  double price = price_of_size(fit, fault, claim, e) + shrinking;
  if (claim.kind == FaultKind::free_swinging || claim.kind == FaultKind::torque_sensor_error)
    price += price_of_following(fit, claim);
  FaultHypothesis out = hypothesis(fit, claim, std::move(e), price);
  out.shrinking = shrinking;
  return out;
}

FaultHypothesis judge_collision(const LogFit& fit, FaultClaim claim) {
  if (claim.end_s < kNeverEnds) return judge_force(fit, claim);
  FaultHypothesis best;
  for (const double duration : {.03, .06, .12, .25, .5, 1.0}) {
    claim.end_s = claim.onset_s + duration;
    FaultHypothesis h = judge_force(fit, claim);
    if (h.gain > best.gain) best = std::move(h);
  }
  return best;
}

}  // namespace

double price_of_shrinking(const LogFit& fit, const FaultClaim& claim, const Explanation& e) {
  if (column_kind(claim.kind) != FaultKind::torque_loss) return 0.0;
  const BalanceModel& m = fit.model();
  const int j = claim.joint.index(), effects = day_layout(m).count();
  VectorXd day = e.day;
  day.tail(day.size() - effects).setZero();
  const VectorXd usual = fit.rows().column[j] * m.theta,
                 changed = fit.day_torque(day).segment(j * fit.count(), fit.count());
  std::vector<int> rows;
  for (int k = 0; k < fit.count(); ++k)
    if (fit.time_s()[k] > claim.onset_s && fit.time_s()[k] < claim.end_s && fit.std()(k, j) < kNoWeight)
      rows.push_back(k);
  const double square = usual(rows).squaredNorm(), product = usual(rows).dot(changed(rows)),
               share = 1.0 + (square > 0.0 ? product / square : 0.0);
  double out = 0.0;
  for (const int k : rows) {
    const double most = free_row_price(fit, k, j);
    out += share > 0.0 ? std::clamp(-elementary::log(share), 0.0, most) : most;
  }
  return out;
}

FaultHypothesis judge_clipped(const LogFit& fit, FaultClaim claim) {
  claim.kind = FaultKind::unknown;
  const int j = claim.joint.index();
  const VectorXd torque = fit.rows().torque.col(j);
  FaultHypothesis best;
  double most = 0.0, best_level = 0.0;
  for (int k = 0; k < fit.count(); ++k)
    if (fit.time_s()[k] > claim.onset_s && fit.time_s()[k] < claim.end_s)
      most = std::max(most, std::abs(torque[k]));
  const auto try_level = [&](double level) {
    FaultColumns lost{StackedColumns::Zero(fit.count() * fit.joints(), 1),
                      VectorXd::Constant(1, kClippedDoubt * kClippedDoubt)};
    lost.column.col(0).segment(j * fit.count(), fit.count()) =
        torque - torque.cwiseMin(level).cwiseMax(-level);
    lost = fit.between(lost, claim.onset_s, claim.end_s);
    const Stacked clipped = fit.residual() - lost.column.col(0);
    FaultHypothesis h =
        hypothesis(fit, claim, fit.explain_with_piece(clipped, lost, {}, claim.onset_s), kPriceOfClipping);
    if (h.gain <= best.gain) return;
    best = std::move(h);
    best_level = level;
  };
  for (double share = 0.8; share > kLeastClip; share *= 0.7) try_level(share * most);
  for (const double factor : {1.2, 1.1, 1.05})
    for (const double level : {best_level * factor, best_level / factor})
      if (level > kLeastClip * most) try_level(level);
  best.size = VectorXd::Constant(1, best_level);
  return best;
}

std::optional<FaultHypothesis> judge(const LogFit& fit, const FaultClaim& claim, double rival) {
  switch (claim.kind) {
    case FaultKind::free_swinging:
    case FaultKind::torque_loss:
    case FaultKind::friction_increase:
    case FaultKind::payload_change:
    case FaultKind::torque_sensor_error:
      if (const LinearFault* fault = linear_of(fit.linear(), claim)) return judge_linear(fit, *fault, claim);
      return std::nullopt;
    case FaultKind::collision:
      return judge_collision(fit, claim);
    case FaultKind::sensor_bias:
    case FaultKind::sensor_drift:
      return judge_false_position(fit, claim, rival);
    case FaultKind::locked:
    case FaultKind::stuck_encoder:
    case FaultKind::unknown:
      return judge_silent(fit, claim);
    default:
      return std::nullopt;
  }
}

}  // namespace faultline
