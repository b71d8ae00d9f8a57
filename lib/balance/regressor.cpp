// SPDX-License-Identifier: MIT
#include "lib/balance/regressor.hpp"

#include <Eigen/Geometry>

#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Eigen::Vector3d;

/// s^T I w for the six entries of a symmetric I.
void add_inertia_entries(const Vector3d& s, const Vector3d& w, double* out) {
  out[0] += s.x() * w.x();
  out[1] += s.y() * w.y();
  out[2] += s.z() * w.z();
  out[3] += s.x() * w.y() + s.y() * w.x();
  out[4] += s.x() * w.z() + s.z() * w.x();
  out[5] += s.y() * w.z() + s.z() * w.y();
}

/// Inner product of the test twist `s` with the momentum of a link that moves with `v`, by link parameter.
LinkVector momentum_row(const Twist& s, const Twist& v) {
  LinkVector row = LinkVector::Zero();
  row[0] = s.linear.dot(v.linear);
  row.segment<3>(1) = s.linear.cross(v.angular) + v.linear.cross(s.angular);
  add_inertia_entries(s.angular, v.angular, row.data() + 4);
  return row;
}

Twist cross(const Twist& a, const Twist& b) {
  return {a.angular.cross(b.angular), a.angular.cross(b.linear) + a.linear.cross(b.angular)};
}

void add_scaled(Twist& sum, const Twist& t, double rate) {
  sum.angular += rate * t.angular;
  sum.linear += rate * t.linear;
}

Twist link_twist(const LinkFrames& frames, int link, const JointVector& dq) {
  Twist v;
  for (int k = 0; k <= link; ++k) add_scaled(v, frames.twist[link][k], dq[k]);
  return v;
}

void reset(LinkRegressor& out, int n) { out.setZero(n, n * kLinkParameters); }

}  // namespace

LinkVector to_vector(const LinkInertia& link) {
  LinkVector v;
  const auto& i = link.inertia;
  v << link.mass, link.first_moment, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2);
  return v;
}

LinkInertia link_from(const LinkVector& v) {
  LinkInertia link;
  link.mass = v[0];
  link.first_moment = v.segment<3>(1);
  link.inertia << v[4], v[7], v[8], v[7], v[5], v[9], v[8], v[9], v[6];
  return link;
}

LinkFrames link_frames(const Chain& chain, const JointVector& q) {
  LinkFrames frames;
  frames.joints = chain.joints();
  Vector3d gravity = chain.gravity;
  for (int j = 0; j < frames.joints; ++j) {
    const auto pose = link_pose(chain, j, q[j]);
    const Eigen::Matrix3d to_link = pose.rotation.transpose();
    for (int i = 0; i < j; ++i) {
      const Twist& before = frames.twist[j - 1][i];
      frames.twist[j][i] = {to_link * before.angular,
                            to_link * (before.linear + before.angular.cross(pose.position))};
    }
    const JointGeometry& joint = chain.geometry[j];
    Twist& own = frames.twist[j][j];
    (joint.kind == AxisKind::revolute ? own.angular : own.linear) = joint.axis;
    gravity = (to_link * gravity).eval();
    frames.gravity[j] = gravity;
  }
  return frames;
}

void momentum_regressor(const LinkFrames& frames, const JointVector& dq, LinkRegressor& out) {
  reset(out, frames.joints);
  for (int j = 0; j < frames.joints; ++j) {
    const Twist v = link_twist(frames, j, dq);
    for (int i = 0; i <= j; ++i)
      out.block<1, kLinkParameters>(i, j * kLinkParameters) = momentum_row(frames.twist[j][i], v).transpose();
  }
}

void force_regressor(const LinkFrames& frames, const JointVector& dq, LinkRegressor& out) {
  reset(out, frames.joints);
  for (int j = 0; j < frames.joints; ++j) {
    const Twist v = link_twist(frames, j, dq);
    Twist inboard;  // motion of link i, seen at link j
    for (int i = 0; i <= j; ++i) {
      const Twist& s = frames.twist[j][i];
      add_scaled(inboard, s, dq[i]);
      LinkVector row = momentum_row(cross(inboard, s), v);
      row[0] += frames.gravity[j].dot(s.linear);
      row.segment<3>(1) += frames.gravity[j].cross(s.angular);
      out.block<1, kLinkParameters>(i, j * kLinkParameters) = row.transpose();
    }
  }
}

void torque_regressor(const Chain& chain, const JointVector& q, const JointVector& dq, const JointVector& ddq,
                      LinkRegressor& out) {
  const LinkFrames frames = link_frames(chain, q);
  reset(out, frames.joints);
  Vector3d omega = Vector3d::Zero(), alpha = Vector3d::Zero(), acceleration = -chain.gravity;
  for (int j = 0; j < frames.joints; ++j) {
    const JointGeometry& joint = chain.geometry[j];
    const auto pose = link_pose(chain, j, q[j]);
    const Eigen::Matrix3d to_link = pose.rotation.transpose();
    const Vector3d& p = pose.position;
    acceleration = (to_link * (acceleration + alpha.cross(p) + omega.cross(omega.cross(p)))).eval();
    omega = (to_link * omega).eval();
    alpha = (to_link * alpha).eval();
    if (joint.kind == AxisKind::revolute) {
      alpha += joint.axis * ddq[j] + omega.cross(joint.axis) * dq[j];
      omega += joint.axis * dq[j];
    } else {
      acceleration += joint.axis * ddq[j] + 2.0 * omega.cross(joint.axis) * dq[j];
    }
    for (int i = 0; i <= j; ++i) {
      const Twist& s = frames.twist[j][i];
      LinkVector row = LinkVector::Zero();
      row[0] = s.linear.dot(acceleration);
      row.segment<3>(1) = s.linear.cross(alpha) + omega * omega.dot(s.linear) -
                          omega.squaredNorm() * s.linear + acceleration.cross(s.angular);
      add_inertia_entries(s.angular, alpha, row.data() + 4);
      add_inertia_entries(s.angular.cross(omega), omega, row.data() + 4);
      out.block<1, kLinkParameters>(i, j * kLinkParameters) = row.transpose();
    }
  }
}

}  // namespace faultline
