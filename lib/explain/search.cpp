// SPDX-License-Identifier: MIT
#include "lib/explain/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/explain/sensor_jumps.hpp"
#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kApart_s = 0.15;  // between two onsets of one kind and joint
constexpr int kImpulse = 2000;     // rows of the filter's response that its variance is summed over
constexpr double kNothing = -std::numeric_limits<double>::infinity();
constexpr double kStep = 1e-3;  // rad or m of a numeric derivative

/// What the search keeps of the healthy explanation: white noise of the healthy size. A hard edge of an onset
/// would be blown up by the whitening.
struct WhiteSearch {
  const LogFit& fit;
  VectorXd precision;   ///< by joint, of a row over its standard deviation
  MatrixXd covariance;  ///< of the effects of the day
  Stacked left;         ///< torque left over, effects of the day taken away
};

/// Variance of a process whose innovations are one, from its autoregression.
double process_variance(const VectorXd& filter) {
  std::vector<double> h(kImpulse, 0.0);
  double sum = 0.0;
  for (int k = 0; k < kImpulse; ++k) {
    double v = k == 0 ? 1.0 : 0.0;
    for (int lag = 1; lag < filter.size() && lag <= k; ++lag) v -= filter[lag] * h[k - lag];
    h[k] = v;
    sum += v * v;
  }
  return sum;
}

WhiteSearch white_search(const LogFit& fit) {
  const BalanceModel& m = fit.model();
  WhiteSearch out{fit, VectorXd(fit.joints()), {}, {}};
  MatrixXd a = m.day_variance.cwiseInverse().asDiagonal();
  VectorXd b = VectorXd::Zero(a.rows());
  Stacked y = fit.residual();
  if (fit.has_piece()) y -= fit.piece_torque(fit.healthy().piece_level);
  for (int j = 0; j < fit.joints(); ++j) {
    const JointNoise& noise = m.noise.joint[j];
    out.precision[j] = 1.0 / (noise.innovation * noise.innovation * process_variance(noise.filter));
    const VectorXd inverse = fit.std().col(j).cwiseInverse();
    const MatrixXd w = inverse.asDiagonal() * fit.day_columns()[j];
    a += out.precision[j] * w.transpose() * w;
    b += out.precision[j] * w.transpose() * y.segment(j * fit.count(), fit.count()).cwiseProduct(inverse);
  }
  out.covariance = a.ldlt().solve(MatrixXd::Identity(a.rows(), a.cols()));
  out.left = y - fit.day_torque(out.covariance * b);
  return out;
}

/// Gain of columns that are switched on at each row. With `fixed`, the sizes are given row by row instead.
VectorXd onset_gains(const WhiteSearch& s, const FaultColumns& columns, const MatrixXd* fixed = nullptr) {
  const int rows = s.fit.count(), k = columns.sizes(), effects = static_cast<int>(s.covariance.rows());
  MatrixXd square = MatrixXd::Zero(k, k), cross = MatrixXd::Zero(k, effects);
  VectorXd vector = VectorXd::Zero(k), out(rows);
  double log_prior = 0.0;
  for (int i = 0; i < k && fixed == nullptr; ++i) log_prior += 0.5 * elementary::log(columns.variance[i]);
  for (int t = rows - 1; t >= 0; --t) {
    for (int j = 0; j < s.fit.joints(); ++j) {
      const Eigen::RowVectorXd x = columns.column.row(j * rows + t);
      if (x.isZero(0.0)) continue;
      const double std = s.fit.std()(t, j), weight = s.precision[j] / (std * std);
      square += weight * x.transpose() * x;
      vector += weight * s.left[j * rows + t] * x.transpose();
      cross += weight * x.transpose() * s.fit.day_columns()[j].row(t);
    }
    MatrixXd inner = square - cross * s.covariance * cross.transpose();
    if (fixed != nullptr) {
      const VectorXd size = fixed->row(t).transpose();
      out[t] = size.dot(vector) - 0.5 * size.dot(inner * size);
      continue;
    }
    inner.diagonal() += columns.variance.cwiseInverse();
    const Eigen::LLT<MatrixXd> factor(inner);
    double log_posterior = 0.0;
    for (int i = 0; i < k; ++i) log_posterior += elementary::log(factor.matrixLLT()(i, i));
    out[t] = 0.5 * vector.dot(factor.solve(vector)) - log_posterior - log_prior;
  }
  return out;
}

/// The `most` highest peaks that are kApart_s apart, of rows that may hold an onset.
void note(const LogFit& fit, FaultKind kind, int joint, VectorXd score, double start, int most,
          std::vector<Candidate>& out) {
  const double row_s = fit.model().setting.row_s();
  const int first = std::max(6, static_cast<int>(kLead_s / row_s)), last = fit.count() - kTail;
  const int apart = std::max(1, static_cast<int>(kApart_s / row_s));
  for (int k = 0; k < fit.count(); ++k)
    if (k < first || k >= last || !(score[k] > kNothing)) score[k] = kNothing;
  for (int n = 0; n < most; ++n) {
    Eigen::Index at = 0;
    const double best = score.maxCoeff(&at);
    if (best == kNothing) return;
    out.push_back({kind, joint, fit.time_s()[at], best, start});
    const int a = std::max(0, static_cast<int>(at) - apart),
              b = std::min(fit.count(), static_cast<int>(at) + apart + 1);
    score.segment(a, b - a).setConstant(kNothing);
  }
}

VectorXd joint_block(const WhiteSearch& s, int j) {  // precision-weighted residual
  const int rows = s.fit.count();
  return s.precision[j] * s.left.segment(j * rows, rows).cwiseQuotient(s.fit.std().col(j).cwiseAbs2());
}

/// Correlation of the residual with the impulse that a sudden change of joint `j`'s velocity gives the
/// momentum, and the impulse's own square, both for each onset.
void impulse_of(const WhiteSearch& s, int j, VectorXd& vector, VectorXd& square) {
  const LogFit& fit = s.fit;
  const RowSetting& setting = fit.model().setting;
  const int rows = fit.count(), half = static_cast<int>(std::ceil(4.0 * setting.kernel_s / setting.row_s()));
  VectorXd kernel(2 * half + 1);
  for (int k = -half; k <= half; ++k) {
    const double x = k * setting.row_s() / setting.kernel_s;
    kernel[half + k] = elementary::exp(-0.5 * x * x) / (setting.kernel_s * std::sqrt(2.0 * std::numbers::pi));
  }
  vector = VectorXd::Zero(rows);
  square = VectorXd::Zero(rows);
  const MatrixXd inertia = inertia_columns(fit, j);
  for (int i = 0; i < fit.joints(); ++i) {
    if (inertia.col(i).isZero(0.0)) continue;
    const VectorXd y = joint_block(s, i);
    for (int t = 0; t < rows; ++t) {
      const int a = std::max(0, t - half), b = std::min(rows, t + half + 1);
      vector[t] -= inertia(t, i) * y.segment(a, b - a).dot(kernel.segment(a - t + half, b - a));
      const double std = fit.std()(t, i);
      square[t] += s.precision[i] / (std * std) * inertia(t, i) * inertia(t, i) * kernel.squaredNorm();
    }
  }
}

/// A drift of joint `j`: friction with the true velocity, positions that are ever more off, and the jump of
/// the velocity at its onset.
void search_drift(const WhiteSearch& s, int j, std::vector<Candidate>& out) {
  const LogFit& fit = s.fit;
  const BalanceModel& m = fit.model();
  const ColumnLayout layout = m.layout();
  const int rows = fit.count();
  const double scale = m.rigid.chain.geometry[j].kind == AxisKind::revolute ? 1.0 : 0.5;
  UniformLog moved = fit.log();
  moved.q.col(j).array() += kStep;
  const Stacked slope = (fit.residual_of(moved) - fit.residual()) / kStep;
  const bool matters = slope.cwiseAbs().maxCoeff() > 1e-9;
  const VectorXd time = fit.time_s().array() - fit.time_s()[0];
  VectorXd impulse, impulse_square;
  impulse_of(s, j, impulse, impulse_square);
  const auto friction = [&](double v) {
    return m.theta[layout.viscous(j)] * v +
           m.theta[layout.coulomb(j)] * elementary::tanh(v / m.setting.friction_width[j]);
  };
  for (const double size : {.003, .006, .012, .02, .03, .04, .06, .1})
    for (const double sign : {-1.0, 1.0}) {
      const double d = scale * sign * size;
      FaultColumns columns;
      columns.column = StackedColumns::Zero(rows * fit.joints(), matters ? 3 : 1);
      for (int k = 0; k < rows; ++k) {
        const double v = fit.rows().dq(k, j);
        columns.column(j * rows + k, 0) = friction(v - d) - friction(v);
      }
      MatrixXd fixed = MatrixXd::Ones(rows, columns.sizes());
      if (matters) {
        for (int i = 0; i < fit.joints(); ++i)
          columns.column.col(1).segment(i * rows, rows) = slope.segment(i * rows, rows).cwiseProduct(time);
        columns.column.col(2) = slope;
        fixed.col(1).setConstant(d);
        fixed.col(2) = -d * time;
      }
      const VectorXd gain = onset_gains(s, columns, &fixed) + d * impulse - 0.5 * d * d * impulse_square;
      note(fit, FaultKind::sensor_drift, j + 1, gain, d, 1, out);
    }
}

/// An unknown force of some length on any joint.
void search_collision(const WhiteSearch& s, std::vector<Candidate>& out) {
  const LogFit& fit = s.fit;
  const int rows = fit.count();
  for (const double length : {.02, .05, .1, .25}) {
    const int m = std::max(1, static_cast<int>(std::lround(length / fit.model().setting.row_s())));
    VectorXd gain = VectorXd::Zero(rows);
    for (int j = 0; j < fit.joints(); ++j) {
      const VectorXd y = joint_block(s, j);
      const double prior = fit.rows().torque.col(j).squaredNorm() / rows;
      VectorXd u = VectorXd::Zero(rows), w = VectorXd::Zero(rows);
      for (int t = 0; t < rows; ++t)
        for (int i = t; i < std::min(rows, t + m); ++i) {
          u[t] += y[i];
          w[t] += s.precision[j] / (fit.std()(i, j) * fit.std()(i, j));
        }
      for (int t = 0; t < rows; ++t)
        gain[t] += 0.5 * u[t] * u[t] / (w[t] + 1.0 / prior) - 0.5 * elementary::log1p(w[t] * prior);
    }
    note(fit, FaultKind::collision, fit.joints(), gain, 0.0, 2, out);
  }
}

/// Since when joint `j` stands still, but for its spring.
void search_standstill(const LogFit& fit, int j, std::vector<Candidate>& out) {
  const BalanceModel& m = fit.model();
  const double row_s = m.setting.row_s(), compliance = m.setting.compliance[j];
  const VectorXd torque = fit.rows().torque.col(j);
  VectorXd x = fit.rows().q.col(j) - compliance * torque;
  const int tail = std::min(fit.count(), static_cast<int>(0.15 / row_s) + 3);
  std::vector<double> end(x.data() + fit.count() - tail, x.data() + fit.count());
  std::nth_element(end.begin(), end.begin() + tail / 2, end.end());
  const double rest = end[tail / 2];
  const double noise = std::max(m.q_noise[j] * fit.loudness()[j], 1e-6) *
                       gaussian_kernel(m.setting.kernel_s, m.setting.period_s).norm();
  const double tolerance = 8.0 * noise + 1e-5 + 0.3 * compliance * (torque.maxCoeff() - torque.minCoeff());
  int since = fit.count();
  while (since > 0 && std::abs(x[since - 1] - rest) <= tolerance) --since;
  const int first = std::max(6, static_cast<int>(kLead_s / row_s));
  for (const int before : {0, 2, 5})
    out.push_back({FaultKind::locked, j + 1,
                   fit.time_s()[std::clamp(since - before, first, fit.count() - kTail)], 0.0, 0.0});
}

}  // namespace

MatrixXd inertia_columns(const LogFit& fit, int j) {
  const BalanceModel& m = fit.model();
  const Chain<double> chain = chain_of(m.rigid, m.theta);
  MatrixXd out(fit.count(), fit.joints());
  for (int t = 0; t < fit.count(); ++t) {
    const JointVector<double> q = fit.rows().q.row(t).transpose();
    out.row(t) = inertia_matrix(chain, q).col(j).transpose();
  }
  return out;
}

std::vector<LinearFault> linear_faults(const LogFit& fit) {
  const BalanceModel& m = fit.model();
  const ColumnLayout layout = m.layout();
  const int rows = fit.count(), n = fit.joints();
  std::vector<LinearFault> out;
  for (int j = 0; j < n; ++j) {
    LinearFault loss{
        FaultKind::torque_loss, j + 1, {StackedColumns::Zero(rows * n, 1), VectorXd::Constant(1, 0.25)}, {}};
    loss.columns.column.col(0).segment(j * rows, rows) = fit.rows().torque.col(j);
    if (fit.has_piece() && carries_weight(m.rigid, j))
      for (const double size : {.4, .7, 1.}) loss.starts.push_back(VectorXd::Constant(1, size));
    out.push_back(std::move(loss));
  }
  for (int j = 0; j < n; ++j) {
    const double fv = m.theta[layout.viscous(j)], fc = m.theta[layout.coulomb(j)];
    LinearFault friction{
        FaultKind::friction_increase, j + 1, {StackedColumns::Zero(rows * n, 2), VectorXd(2)}, {}};
    friction.columns.column.col(0).segment(j * rows, rows) = fit.rows().column[j].col(layout.viscous(j));
    friction.columns.column.col(1).segment(j * rows, rows) = fit.rows().column[j].col(layout.coulomb(j));
    friction.columns.variance << 9.0 * fv * fv + 1e-6, 9.0 * fc * fc + 1e-6;
    if (fit.has_piece() && carries_weight(m.rigid, j)) {
      friction.starts.push_back(Eigen::Vector2d(fv, 1.5 * fc));
      friction.starts.push_back(Eigen::Vector2d(2.0 * fv, 3.0 * fc));
    }
    out.push_back(std::move(friction));
  }
  const double mass = carried_mass(fit);
  LinearFault payload{FaultKind::payload_change,
                      n,
                      {stacked(fit.tip_torque()), VectorXd::Constant(1, 0.36 * mass * mass)},
                      {}};
  if (fit.has_piece())
    for (const double share : {.25, .6, 1.}) payload.starts.push_back(VectorXd::Constant(1, share * mass));
  out.push_back(std::move(payload));
  return out;
}

double carried_mass(const LogFit& fit) {
  const Eigen::MatrixXd torque = torque_of(fit.rows(), fit.model().theta);
  double num = 0.0, den = 0.0;
  for (int j = fit.joints() - 1; j < fit.joints(); ++j) {
    num += torque.col(j).dot(fit.tip_torque().col(j));
    den += fit.tip_torque().col(j).squaredNorm();
  }
  return den > 0.0 ? std::abs(num / den) : 1.0;
}

std::vector<Candidate> search(const LogFit& fit, const std::vector<LinearFault>& linear) {
  const WhiteSearch s = white_search(fit);
  std::vector<Candidate> out;
  for (const LinearFault& fault : linear)
    note(fit, fault.kind, fault.joint, onset_gains(s, fault.columns), 0.0, 2, out);
  for (int j = 0; j < fit.joints(); ++j) search_drift(s, j, out);
  search_collision(s, out);
  for (int j = 0; j < fit.joints(); ++j) {
    search_standstill(fit, j, out);
    for (const SensorJump& jump : sensor_jumps(fit, j))
      out.push_back({FaultKind::sensor_bias, j + 1, jump.onset_s, 10.0, jump.size});
    if (const auto run = repeated_to_the_end(fit, j)) {
      out.push_back({FaultKind::stuck_encoder, j + 1, run->onset_s, 1e3, 0.0});
      out.push_back({FaultKind::locked, j + 1, run->onset_s, 1e3, 0.0});
    }
  }
  return out;
}

}  // namespace faultline
