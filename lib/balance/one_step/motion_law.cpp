// SPDX-License-Identifier: MIT
#include "lib/balance/one_step/motion_law.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "lib/balance/regressor.hpp"
#include "lib/balance/rows.hpp"
#include "lib/core/elementary/elementary.hpp"

namespace faultline {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNudge = 1e-6;  // rad, m, rad/s or m/s: step of a numeric derivative; its error is as small

Chain chain_with_friction(const MotionBody& body, const VectorXd& numbers) {
  const MotionLayout at = body.layout();
  Chain chain = chain_of(body.rigid(), numbers.head(at.base));
  chain.friction.assign(at.joints, {});
  for (int j = 0; j < at.joints; ++j) {
    chain.friction[j].viscous = numbers[at.viscous(j)];
    chain.friction[j].coulomb = numbers[at.coulomb(j)];
    chain.friction[j].width = body.friction_width()[j];
  }
  return chain;
}

}  // namespace

MotionBody::MotionBody(RigidColumns rigid, VectorXd friction_width)
    : rigid_(std::move(rigid)), friction_width_(std::move(friction_width)) {
  rigid_.chain.friction.assign(rigid_.joints(), {});
  unit_ = unit_dynamics(rigid_);
}

void MotionBody::torque_by_parameter(const JointVector& q, const JointVector& dq, const JointVector& ddq,
                                     Eigen::Ref<MatrixXd> out) const {
  if (!unit_.empty()) {
    const FastDynamics::Pose pose = unit_.front().pose(q);
    for (std::size_t p = 0; p < unit_.size(); ++p)
      out.col(static_cast<Eigen::Index>(p)) = unit_[p].planar_torque(pose, dq, ddq);
    return;
  }
  LinkRegressor links;
  torque_regressor(rigid_.chain, q, dq, ddq, links);
  const int n = rigid_.joints();
  out.noalias() = links * rigid_.lift.topRows(n * kLinkParameters);
  for (int j = 0; j < n; ++j) out.row(j) += ddq[j] * rigid_.lift.row(n * kLinkParameters + j);
}

MotionLaw::MotionLaw(const MotionBody& body, const VectorXd& numbers, unsigned locked)
    : body_(&body),
      dynamics_(chain_with_friction(body, numbers)),
      gain_(numbers.segment(body.layout().gain(0), body.layout().joints)),
      force_(numbers.segment(body.layout().force(0), body.layout().joints)),
      locked_(locked) {}

void MotionLaw::acceleration(const JointVector& q, const JointVector& dq, const JointVector& tau,
                             JointVector& ddq) const {
  const JointVector acting = gain_.cwiseProduct(tau) + force_;
  dynamics_.acceleration(q, dq, acting, ddq, locked_);
}

JointVector MotionLaw::friction_rate(const JointVector& q) const {
  const int n = joints();
  JointMatrix inertia;
  JointVector bias, out(n);
  dynamics_.inertia_and_bias(q, JointVector::Zero(n), inertia, bias);
  const JointMatrix inverse = inertia.llt().solve(JointMatrix::Identity(n, n));
  for (int j = 0; j < n; ++j) {
    const Friction& f = dynamics_.chain().friction[j];
    out[j] = inverse(j, j) * std::max(0.0, f.viscous + f.coulomb / f.width);
  }
  return out;
}

void MotionLaw::acceleration_and_slopes(const JointVector& q, const JointVector& dq, const JointVector& tau,
                                        JointVector& ddq, MotionSlopes& out) const {
  const int n = joints();
  const MotionLayout at = body_->layout();
  StateMatrix by_state = StateMatrix::Zero(n, 2 * n);
  JointMatrix inertia;
  JointVector bias, lost;
  dynamics_.inertia_and_bias(q, dq, inertia, bias);
  const JointVector acting = gain_.cwiseProduct(tau) + force_;
  dynamics_.drag(q, dq, acting, lost);
  ddq = acting - bias - lost;
  JointMatrix factor = inertia;
  factor_small(n, factor.data(), locked_);
  solve_factored(n, factor.data(), ddq.data(), locked_);
  const JointVector torque = bias + inertia.lazyProduct(ddq);
  JointVector moved = q;
  for (int j = 0; j < n; ++j) {
    if (!dynamics_.depends_on_position(j)) continue;
    moved[j] = q[j] + kNudge;
    by_state.col(j) = (torque - dynamics_.body_torque(moved, dq, ddq)) / kNudge;
    moved[j] = q[j];
  }
  moved = dq;
  const bool is_planar = dynamics_.planar() && dynamics_.chain().shared_drives.empty();
  const FastDynamics::Pose pose = is_planar ? dynamics_.pose(q) : FastDynamics::Pose{};
  const auto torque_at = [&](const JointVector& velocity) {
    return is_planar ? dynamics_.planar_torque(pose, velocity, ddq) : dynamics_.body_torque(q, velocity, ddq);
  };
  out.torque.setZero(n, at.count());
  body_->torque_by_parameter(q, dq, ddq, out.torque.leftCols(at.base));
  out.torque.leftCols(at.base) *= -1.0;
  for (int j = 0; j < n; ++j) {
    const Friction& f = dynamics_.chain().friction[j];
    const double saturated = elementary::tanh(dq[j] / f.width);
    if (dynamics_.depends_on_velocity(j)) {
      moved[j] = dq[j] + kNudge;
      by_state.col(n + j) = (torque - torque_at(moved)) / kNudge;
      moved[j] = dq[j];
    }
    by_state(j, n + j) -= f.viscous + f.coulomb / f.width * (1.0 - saturated * saturated);
    out.torque(j, at.viscous(j)) = -dq[j];
    out.torque(j, at.coulomb(j)) = -saturated;
    out.torque(j, at.gain(j)) = tau[j];
    out.torque(j, at.force(j)) = 1.0;
  }
  out.inverse.setZero(n, n);
  for (int i = 0; i < n; ++i) {
    if (is_locked(i)) continue;
    JointVector column = JointVector::Unit(n, i);
    solve_factored(n, factor.data(), column.data(), locked_);
    out.inverse.col(i) = column;
  }
  out.by_state = out.inverse.lazyProduct(by_state);
}

}  // namespace faultline
