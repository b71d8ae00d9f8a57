// SPDX-License-Identifier: MIT
#include "lib/explain/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/sensor_jumps.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kImpossible = 1e9;    // nats that a size costs that no fault has
constexpr double kFreeLoss = 0.9;      // share of the torque from which a joint swings freely
constexpr double kDroppedCost = 1.2;   // nats a row that an unknown force explains
constexpr double kStandingCost = 3.0;  // nats of a joint that does not move

/// Columns switched on at the onset.
FaultColumns from_onset(const FaultColumns& columns, const VectorXd& step) {
  FaultColumns out = columns;
  const Eigen::Index rows = step.size();
  for (Eigen::Index at = 0; at < out.column.rows(); at += rows)
    out.column.middleRows(at, rows) = step.asDiagonal() * columns.column.middleRows(at, rows);
  return out;
}

/// Nats that a size costs that this kind does not have.
double price_of_size(const LogFit& fit, FaultKind kind, int j, double onset_s, const VectorXd& size) {
  if (kind == FaultKind::torque_loss)
    return kImpossible * std::max(0.0, -size[0]) + 2e4 * std::max(0.0, size[0] - 1.2);
  if (kind == FaultKind::payload_change) return size[0] < 0.0 ? kImpossible : 0.0;
  double power = 0.0;  // that the friction takes
  int rows = 0;
  for (int k = 0; k < fit.count(); ++k) {
    if (fit.time_s()[k] <= onset_s) continue;
    const double v = fit.rows().dq(k, j);
    power += (size[0] * v + size[1] * elementary::tanh(v / fit.model().setting.friction_width[j])) * v;
    ++rows;
  }
  return rows < 3 || power <= 0.0 ? kImpossible : 0.0;
}

FaultHypothesis hypothesis(const LogFit& fit, FaultKind kind, int joint, double onset_s,
                           Explanation explanation, double price) {
  FaultHypothesis out;
  out.kind = kind;
  out.joint = joint;
  out.onset_s = onset_s;
  out.gain = explanation.log_likelihood - price - fit.healthy().log_likelihood;
  out.size = explanation.size;
  out.fit = std::move(explanation);
  return out;
}

FaultHypothesis judge_linear(const LogFit& fit, const LinearFault& fault, double onset_s) {
  const FaultColumns columns = from_onset(fault.columns, fit.soft_step(onset_s));
  Explanation e = fit.explain_with_piece(fit.residual(), columns, fault.starts, onset_s);
  const double price = price_of_size(fit, fault.kind, fault.joint - 1, onset_s, e.size);
  const bool free = fault.kind == FaultKind::torque_loss && e.size[0] > kFreeLoss;
  return hypothesis(fit, free ? FaultKind::free_swinging : fault.kind, fault.joint, onset_s, std::move(e),
                    price);
}

FaultHypothesis judge_collision(const LogFit& fit, double onset_s) {
  const int rows = fit.count(), n = fit.joints();
  FaultHypothesis best;
  best.gain = -std::numeric_limits<double>::infinity();
  for (const double duration : {.03, .06, .12, .25, .5}) {
    const VectorXd pulse = fit.soft_step(onset_s) - fit.soft_step(onset_s + duration);
    FaultColumns columns{StackedColumns::Zero(rows * n, n), VectorXd(n)};
    for (int j = 0; j < n; ++j) {
      columns.column.col(j).segment(j * rows, rows) = pulse;
      columns.variance[j] = fit.rows().torque.col(j).squaredNorm() / rows;
    }
    std::vector<VectorXd> starts;
    if (fit.has_piece()) starts.push_back(VectorXd::Zero(n));
    FaultHypothesis h = hypothesis(fit, FaultKind::collision, n, onset_s,
                                   fit.explain_with_piece(fit.residual(), columns, starts, onset_s), 0.0);
    h.duration_s = duration;
    (h.size.cwiseAbs2().cwiseQuotient(columns.variance)).maxCoeff(&h.joint);
    ++h.joint;
    if (h.gain > best.gain) best = std::move(h);
  }
  return best;
}

/// The log as it would be without a false reading of size `size` from `onset_s` on.
UniformLog corrected(const UniformLog& log, FaultKind kind, int j, double onset_s, double size) {
  UniformLog out = log;
  for (int k = 0; k < log.rows(); ++k) {
    const double late = log.time_s(k) - onset_s;
    if (late < -1e-9) continue;
    if (kind == FaultKind::sensor_bias) {
      out.q(k, j) -= size;
    } else {
      out.q(k, j) -= size * std::max(late, 0.0);
      if (out.dq.rows() > 0) out.dq(k, j) -= size;
    }
  }
  return out;
}

/// A reading that is off: the trajectory is corrected and the residual computed anew, linear in the size
/// about the size before.
FaultHypothesis judge_reading(const LogFit& fit, FaultKind kind, int joint, double onset_s, double start) {
  const int j = joint - 1;
  const bool slide = fit.model().rigid.chain.geometry[j].kind == AxisKind::prismatic,
             bias = kind == FaultKind::sensor_bias;
  const double usual = bias ? (slide ? 0.02 : 0.1) : (slide ? 0.03 : 0.1);
  const double step = (bias ? 1e-3 : 2e-3) * (slide ? 0.2 : 1.0);
  FaultHypothesis best;
  best.gain = -std::numeric_limits<double>::infinity();
  double size = start;
  for (int round = 0; round < (bias ? 2 : 3); ++round) {
    const Stacked at = fit.residual_of(corrected(fit.log(), kind, j, onset_s, size));
    const Stacked next = fit.residual_of(corrected(fit.log(), kind, j, onset_s, size + step));
    FaultColumns columns{StackedColumns((at - next) / step),
                         VectorXd::Constant(1, Eigen::numext::abs2(0.3 * size) + 1e-10)};
    std::vector<VectorXd> starts;
    if (fit.has_piece()) starts.push_back(VectorXd::Zero(1));
    Explanation e = fit.explain_with_piece(at, columns, starts, onset_s);
    // The size's own prior in place of the one about the size before.
    const double price =
        0.5 * size * size / (usual * usual) + elementary::log(usual / std::sqrt(columns.variance[0]));
    const double change = e.size[0];
    FaultHypothesis h = hypothesis(fit, kind, joint, onset_s, std::move(e), price);
    h.size = VectorXd::Constant(1, size + change);
    if (h.gain > best.gain) best = std::move(h);
    size += std::clamp(change, -0.5 * std::abs(size), 0.5 * std::abs(size));
  }
  return best;
}

/// Nats by which a joint that is said to be locked moves, but for its spring.
double price_of_motion(const LogFit& fit, int j, const std::vector<int>& late) {
  const BalanceModel& m = fit.model();
  const double compliance = m.setting.compliance[j];
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

/// Samples after the onset, and the share of them that repeat the position before.
std::pair<int, double> repeats_after(const LogFit& fit, int j, double onset_s) {
  const UniformLog& log = fit.log();
  int first = 0;
  while (first < log.rows() && log.time_s(first) < onset_s - 1e-9) ++first;
  int same = 0, all = 0;
  for (int k = first + 3; k < log.rows(); ++k, ++all) same += log.q(k, j) == log.q(k - 1, j);
  return {log.rows() - first, all > 2 ? static_cast<double>(same) / all : 0.0};
}

/// Hypotheses by which rows of a joint say nothing from the onset on.
std::optional<FaultHypothesis> judge_silent(const LogFit& fit, FaultKind kind, int joint, double onset_s) {
  const BalanceModel& m = fit.model();
  const int j = joint - 1, rows = fit.count();
  const bool slide = m.rigid.chain.geometry[j].kind == AxisKind::prismatic;
  StackedMask dropped(static_cast<std::size_t>(rows * fit.joints()), false);
  std::vector<int> late;
  int lost = 0;
  for (int k = 0; k < rows; ++k) {
    if (fit.time_s()[k] > onset_s + 3.0 * m.setting.kernel_s + 0.02) late.push_back(k);
    if (fit.time_s()[k] <= onset_s - 1.5 * m.setting.kernel_s) continue;
    for (int i = 0; i < fit.joints(); ++i) {
      const bool coupled =
          kind == FaultKind::stuck_encoder && !slide && m.rigid.chain.geometry[i].kind == AxisKind::revolute;
      if (i != j && !coupled) continue;
      dropped[i * rows + k] = true;
      ++lost;
    }
  }
  const auto [samples, same] = repeats_after(fit, j, onset_s);
  const bool telling = repeats_say_something(m, j);
  double price = kDroppedCost * lost;
  if (kind == FaultKind::locked) {
    if (late.size() < 5) return std::nullopt;
    price = price_of_motion(fit, j, late) + kStandingCost;
    if (same > 0.98 && telling) price += 2.0 * samples;
  } else if (kind == FaultKind::stuck_encoder) {
    price = kStandingCost + (slide ? 0.0 : 0.5 * kDroppedCost * lost);
    if (same < 0.98 || samples * m.setting.period_s < (telling ? 0.0 : 0.1)) return std::nullopt;
    if (telling) price -= std::min(samples, 500) * elementary::log(1.0 / m.repeat_share[j]);
  }
  Explanation e = fit.explain_with_piece(fit.residual(), {}, {}, onset_s, dropped);
  return hypothesis(fit, kind, joint, onset_s, std::move(e), price);
}

}  // namespace

std::optional<FaultHypothesis> judge(const LogFit& fit, const std::vector<LinearFault>& linear,
                                     FaultKind kind, int joint, double onset_s, double start) {
  switch (kind) {
    case FaultKind::free_swinging:
      return judge(fit, linear, FaultKind::torque_loss, joint, onset_s, start);
    case FaultKind::torque_loss:
    case FaultKind::friction_increase:
    case FaultKind::payload_change:
      for (const LinearFault& fault : linear)
        if (fault.kind == kind && fault.joint == joint) return judge_linear(fit, fault, onset_s);
      return std::nullopt;
    case FaultKind::collision:
      return judge_collision(fit, onset_s);
    case FaultKind::sensor_bias:
    case FaultKind::sensor_drift:
      return judge_reading(fit, kind, joint, onset_s, start);
    case FaultKind::locked:
    case FaultKind::stuck_encoder:
    case FaultKind::unknown:
      return judge_silent(fit, kind, joint, onset_s);
    default:
      return std::nullopt;
  }
}

}  // namespace faultline
