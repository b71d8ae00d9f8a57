// SPDX-License-Identifier: MIT
#include "lib/balance/one_step/one_step_model.hpp"

#include "lib/balance/balance_model.hpp"
#include "lib/balance/one_step/innovations.hpp"
#include "lib/balance/smoothing.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kQuietForce = 1e-3;     // share of the usual torque: force that the model lacks at rest
constexpr double kModelLacks = 0.004;    // share of the torque and of each model term: the same under load
constexpr double kRestLacks = 0.3;       // share of Coulomb friction: error of its tanh near rest
constexpr double kUnknownTorque = 30.0;  // times the usual torque: unknown force if the torque was not logged

}  // namespace

VectorXd OneStepModel::numbers() const {
  VectorXd out = VectorXd::Zero(layout().count());
  out.head(theta.size()) = theta;
  out.segment(layout().gain(0), joints()).setOnes();
  return out;
}

MatrixXd OneStepModel::day_directions() const {
  const MotionLayout at = layout();
  const StepDayLayout day = day_layout();
  MatrixXd out = MatrixXd::Zero(at.count(), day.count());
  for (int p = 0; p < at.base; ++p) out(p, day.inertia(p)) = theta[p];
  for (int j = 0; j < at.joints; ++j) {
    out(at.viscous(j), day.friction(j)) = theta[at.viscous(j)];
    out(at.coulomb(j), day.friction(j)) = theta[at.coulomb(j)];
    const double part = viscous_part(theta[at.viscous(j)], theta[at.coulomb(j)], top_speed[j]);
    out(at.viscous(j), day.viscous_excess(j)) = (1.0 - part) * theta[at.viscous(j)];
    out(at.coulomb(j), day.viscous_excess(j)) = -part * theta[at.coulomb(j)];
    out(at.force(j), day.force(j)) = 1.0;
    out(at.gain(j), day.gain(j)) = 1.0;
  }
  return out;
}

MatrixXd OneStepModel::force_std(const UniformLog& log, const Trajectory& motion) const {
  const int n = joints(), base = layout().base;
  MatrixXd out(n, log.rows() - 1), term(n, base);
  for (int k = 0; k + 1 < log.rows(); ++k) {
    const JointVector ddq = (motion.col(k + 1) - motion.col(k)).tail(n) / setting.period_s;
    body.torque_by_parameter(motion.col(k).head(n), motion.col(k).tail(n), ddq, term);
    const VectorXd square = log.tau.row(k).transpose().cwiseAbs2() +
                            (term * theta.head(base).asDiagonal()).rowwise().squaredNorm();
    VectorXd rest(n);  // the shape of friction near rest is inexact
    for (int j = 0; j < n; ++j)
      rest[j] = kRestLacks * theta[layout().coulomb(j)] *
                share_near_rest(motion(n + j, k), motion(n + j, k + 1), body.friction_width()[j]);
    out.col(k) = rest.cwiseAbs2();
    out.col(k) += kQuietForce * kQuietForce * torque_rms.cwiseAbs2() + kModelLacks * kModelLacks * square;
    out.col(k) = out.col(k).cwiseSqrt().eval();
    if (log.lost[k] || (!setting.torque_is_held && log.lost[k + 1])) out.col(k) = kUnknownTorque * torque_rms;
  }
  return out;
}

MatrixXd OneStepModel::variance_of_readings(const UniformLog& log) const {
  MatrixXd out = reading_variance.replicate(1, log.rows());
  if (log.dq.rows() == 0) out.bottomRows(joints()).setConstant(kMissingReading);
  for (int k = 0; k < log.rows(); ++k)
    if (log.lost[k]) out.col(k).setConstant(kMissingReading);
  return out;
}

Trajectory readings(const UniformLog& log) {
  const int n = log.joints();
  Trajectory out(2 * n, log.rows());
  out.topRows(n) = log.q.transpose();
  if (log.dq.rows() > 0)
    out.bottomRows(n) = log.dq.transpose();
  else
    for (int j = 0; j < n; ++j) out.row(n + j) = gradient(log.q.col(j), log.period_s).transpose();
  return out;
}

}  // namespace faultline
