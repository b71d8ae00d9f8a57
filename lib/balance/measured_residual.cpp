// SPDX-License-Identifier: MIT
#include "lib/balance/measured_residual.hpp"

#include <utility>

#include "lib/balance/rows.hpp"
#include "lib/balance/smoothing.hpp"
#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

MeasuredResidual::MeasuredResidual(const UniformLog& log, RowSetting setting, const RigidColumns& rigid,
                                   VectorXd theta)
    : setting_(std::move(setting)),
      layout_(layout_of(rigid, setting_)),
      theta_(std::move(theta)),
      frame_(row_frame(log, setting_)),
      q_(log.q.transpose()),
      dynamics_(chain_of(rigid, theta_)),
      drive_(frame_.at.torque.rows(), frame_.at.torque.cols()) {
  for (int j = 0; j < rigid.joints(); ++j)
    drive_.col(j) = drive(j, frame_.at.link_speed.col(j), frame_.at.q.col(j));
}

VectorXd MeasuredResidual::drive(int j, const VectorXd& speed, const VectorXd& q) const {
  const VectorXd torque = frame_.at.torque.col(j);
  VectorXd out = torque - theta_[layout_.viscous(j)] * speed -
                 theta_[layout_.coulomb(j)] * saturated(speed, setting_.friction_width[j]) +
                 theta_[layout_.delay(j)] * frame_.at.torque_step.col(j);
  out.array() -= theta_[layout_.offset(j)];
  for (int r = 0; r < layout_.ripples; ++r) {
    const auto [joint, rate] = setting_.ripples[r];
    if (joint != Joint::at(j)) continue;
    const auto t = theta_.segment<4>(layout_.ripple(r));
    for (Index k = 0; k < out.size(); ++k) {
      const auto [s, c] = elementary::sin_cos(rate * q[k]);
      out[k] -= (t[0] * s + t[1] * c) * torque[k] + t[2] * s + t[3] * c;
    }
  }
  return out;
}

MatrixXd MeasuredResidual::carried(const VectorXd& q_of_joint, const VectorXd& velocity, int j,
                                   int from) const {
  const Index samples = q_of_joint.size();
  MatrixXd out(samples - 1 - from, layout_.joints);
  struct {
    JointVector momentum, force;
  } before, now;
  for (Index k = from; k < samples; ++k) {
    JointVector q = q_.col(k), dq = row_of(frame_.at.velocity, k);
    q[j] = q_of_joint[k];
    dq[j] = velocity[k];
    dynamics_.momentum_and_force(q, dq, now.momentum, now.force);
    if (k > from)
      out.row(k - 1 - from) =
          ((now.momentum - before.momentum) / setting_.period_s - 0.5 * (now.force + before.force))
              .transpose();
    std::swap(before, now);
  }
  return out;
}

MatrixXd MeasuredResidual::of_drives(const VectorXd& velocity, const VectorXd& speed, int j) const {
  MatrixXd velocities = frame_.at.velocity, speeds = frame_.at.link_speed;
  velocities.col(j) = velocity;
  speeds.col(j) = speed;
  MatrixXd out = MatrixXd::Zero(speeds.rows(), speeds.cols());
  for (int d = 0; d < layout_.drives; ++d) {
    const CoupledDrive& drive = setting_.drives[d];
    const VectorXd torque =
        drive_columns(drive, velocities, speeds, setting_.period_s) * theta_.segment<3>(layout_.drive(d));
    out += torque * drive.along.transpose();
  }
  return out;
}

MatrixXd MeasuredResidual::of(const MeasuredMotion& moved, int j, int first_row) const {
  const CoarseGrid& grid = frame_.grid;
  const Index samples = moved.q.size();
  const int from = first_row * grid.step;  // first sample within reach of the first row
  const VectorXd velocity = fused_velocity(moved, setting_, j);
  const VectorXd q_middle = 0.5 * (moved.q.head(samples - 1) + moved.q.tail(samples - 1));
  const VectorXd speed = link_speed(velocity, frame_.at.torque.col(j), setting_, j);
  const MatrixXd rigid = carried(moved.q, velocity, j, from);
  const auto at_rows = [&](const MatrixXd& values) {
    return smooth_at(values, frame_.kernel, grid.first, grid.step, grid.count - first_row);
  };
  MatrixXd left = drive_.bottomRows(rigid.rows());
  left.col(j) = drive(j, speed, q_middle).tail(rigid.rows());
  left -= rigid;
  if (layout_.drives > 0) left -= of_drives(velocity, speed, j).bottomRows(rigid.rows());
  MatrixXd out = at_rows(left);
  for (int i = 0; i < layout_.joints; ++i) {
    const double load = theta_[layout_.load(i)];
    if (load == 0.0) continue;
    const VectorXd own = i == j ? speed : frame_.at.link_speed.col(i);
    const MatrixXd turning = at_rows(saturated(own.tail(rigid.rows()), setting_.friction_width[i]));
    out.col(i) -= load * at_rows(rigid.col(i)).cwiseAbs().cwiseProduct(turning);
  }
  return out;
}

}  // namespace faultline
