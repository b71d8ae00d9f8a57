// SPDX-License-Identifier: MIT
#include "lib/identify/days/coarse_start.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "lib/balance/regressor.hpp"
#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kStartRows = 300;       // of each log, by whose predictions a start is chosen
constexpr double kStartRidge = 1e-6;  // of each parameter's own square sum

/// Momentum, and the force that is neither motor nor friction, by base parameter: joints x base each.
struct Balance {
  MatrixXd momentum, force;
};

Balance balance_at(const RigidColumns& rigid, const JointVector<double>& q, const JointVector<double>& dq) {
  const int n = rigid.joints();
  const LinkFrames frames = link_frames(rigid.chain, q);
  const auto lift = rigid.lift.topRows(n * kLinkParameters);
  LinkRegressor links;
  Balance out;
  momentum_regressor(frames, dq, links);
  out.momentum = links * lift + dq.asDiagonal() * rigid.lift.bottomRows(n);
  force_regressor(frames, dq, links);
  out.force = links * lift;
  return out;
}

/// Least squares of momentum differences between neighbouring samples, biased by noise, which makes the robot
/// too light, and by the coarse rate. Each joint counts by its usual torque.
VectorXd by_momentum(const std::vector<UniformLog>& logs, const OneStepModel& model) {
  const MotionLayout at = model.layout();
  const RigidColumns& rigid = model.body.rigid();
  const int n = at.joints;
  MatrixXd square = MatrixXd::Zero(at.learned(), at.learned());
  VectorXd vector = VectorXd::Zero(at.learned());
  for (const UniformLog& log : logs) {
    const Trajectory x = readings(log);
    Balance before = balance_at(rigid, x.col(0).head(n), x.col(0).tail(n));
    for (int k = 0; k + 1 < log.rows(); ++k) {
      Balance after = balance_at(rigid, x.col(k + 1).head(n), x.col(k + 1).tail(n));
      if (!log.lost[k] && !log.lost[k + 1]) {
        MatrixXd row = MatrixXd::Zero(n, at.learned());
        row.leftCols(at.base) =
            (after.momentum - before.momentum) / log.period_s - 0.5 * (after.force + before.force);
        const VectorXd speed = 0.5 * (x.col(k) + x.col(k + 1)).tail(n);
        VectorXd torque = log.tau.row(k).transpose();
        if (!model.setting.torque_is_held) torque = 0.5 * (torque + log.tau.row(k + 1).transpose());
        for (int j = 0; j < n; ++j) {
          row(j, at.viscous(j)) = speed[j];
          row(j, at.coulomb(j)) = elementary::tanh(speed[j] / model.body.friction_width()[j]);
          row.row(j) /= model.torque_rms[j];
          torque[j] /= model.torque_rms[j];
        }
        square.noalias() += row.transpose() * row;
        vector.noalias() += row.transpose() * torque;
      }
      before = std::move(after);
    }
  }
  square.diagonal() *= 1.0 + kStartRidge;
  square.diagonal().array() += 1e-12;
  VectorXd theta = square.ldlt().solve(vector);
  theta.tail(2 * n) = theta.tail(2 * n).cwiseMax(0.0);
  return theta;
}

/// How far one-step predictions by a robot with these numbers miss the readings: mean of log(1 + square / 2),
/// the square in variances of the readings, so that a few wild predictions do not decide; infinite where the
/// robot cannot be integrated.
double prediction_miss(const std::vector<UniformLog>& logs, OneStepModel model, const VectorXd& numbers) {
  model.theta = numbers;
  const MotionLaw law(model.body, model.numbers());
  double sum = 0.0;
  int count = 0;
  for (const UniformLog& log : logs) {
    const Trajectory read = readings(log);
    const int step = std::max(1, log.rows() / kStartRows);
    for (int k = 0; k + 1 < log.rows(); k += step) {
      if (log.lost[k] || log.lost[k + 1]) continue;
      const VectorXd off = next_state(log, k, read, model.setting, {.usual = &law}) - read.col(k + 1);
      const VectorXd square = off.cwiseAbs2().cwiseQuotient(model.reading_variance);
      if (!square.allFinite()) return std::numeric_limits<double>::infinity();
      for (const double each : square) sum += elementary::log1p(0.5 * each);
      ++count;
    }
  }
  return sum / std::max(count, 1);
}

}  // namespace

VectorXd coarse_start(const std::vector<UniformLog>& logs, const OneStepModel& model,
                      const VectorXd& identified_base,
                      const std::vector<Friction<double>>& identified_friction) {
  const MotionLayout at = model.layout();
  VectorXd identified(at.learned());
  identified.head(at.base) = identified_base;
  for (int j = 0; j < at.joints; ++j) {
    identified[at.viscous(j)] = std::max(identified_friction[j].viscous, 0.0);
    identified[at.coulomb(j)] = std::max(identified_friction[j].coulomb, 0.0);
  }
  VectorXd momentum = by_momentum(logs, model);
  return prediction_miss(logs, model, identified) < prediction_miss(logs, model, momentum) ? identified
                                                                                           : momentum;
}

}  // namespace faultline
