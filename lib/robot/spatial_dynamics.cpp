// SPDX-License-Identifier: MIT
#include "lib/robot/spatial_dynamics.hpp"

#include <Eigen/Geometry>
#include <array>

#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A velocity, an acceleration or an axis: its rotational part, and that of the body's point at the origin.
struct Motion {
  Vector3d turn, point;
};

/// A force, or a momentum, and its moment about the origin.
struct Wrench {
  Vector3d force, moment;
};

/// A body in the base frame; first moment and inertia about the origin.
struct Body {
  double mass;
  Vector3d first;
  Matrix3d inertia;

  Wrench operator*(const Motion& m) const {
    return {mass * m.point + m.turn.cross(first), inertia * m.turn + first.cross(m.point)};
  }
};

Body body_at(const LinkInertia& link, const Matrix3d& rotation, const Vector3d& position) {
  const Vector3d first = rotation * link.first_moment;
  Body out{link.mass, first + link.mass * position, rotation * link.inertia * rotation.transpose()};
  const Vector3d moved = 0.5 * (out.first + first);  // first + mass position / 2
  out.inertia.diagonal().array() += 2.0 * position.dot(moved);
  out.inertia -= position * moved.transpose() + moved * position.transpose();
  return out;
}

Motion cross(const Motion& a, const Motion& b) {
  return {a.turn.cross(b.turn), a.turn.cross(b.point) + a.point.cross(b.turn)};
}

void add(const Motion& m, double share, Motion& sum) {
  sum.turn += share * m.turn;
  sum.point += share * m.point;
}

void add(const Wrench& w, Wrench& sum) {
  sum.force += w.force;
  sum.moment += w.moment;
}

double power(const Motion& axis, const Wrench& w) {
  return axis.turn.dot(w.moment) + axis.point.dot(w.force);
}

}  // namespace

/// For each joint, in the base frame: its axis, the velocity of its link, and the link's body.
struct SpatialDynamics::Bodies {
  std::array<Motion, kMaxJoints> axis, speed;
  std::array<Body, kMaxJoints> body;
};

SpatialDynamics::SpatialDynamics(const Chain& chain) : joints_(chain.joints()), gravity_(chain.gravity) {
  for (int i = 0; i < joints_; ++i) {
    const JointGeometry& joint = chain.geometry[i];
    link_[i] = {joint.kind == AxisKind::revolute, joint.axis, link_pose(chain, i, 0.0).position,
                chain.links[i], chain.rotor_inertia.empty() ? 0.0 : chain.rotor_inertia[i]};
  }
}

SpatialDynamics::Bodies SpatialDynamics::in_base(const JointVector& q, const JointVector& dq) const {
  Bodies out;
  Matrix3d rotation = Matrix3d::Identity();
  Vector3d position = Vector3d::Zero();  // from the first joint, in the base frame
  Motion speed{Vector3d::Zero(), Vector3d::Zero()};
  for (int i = 0; i < joints_; ++i) {
    const Link& link = link_[i];
    const Vector3d along = rotation * link.axis;
    if (i > 0) position += rotation * link.position;
    if (link.turns) {
      rotation = (rotation * rotation_about(link.axis, q[i])).eval();
      out.axis[i] = {along, position.cross(along)};
    } else {
      position += q[i] * along;
      out.axis[i] = {Vector3d::Zero(), along};
    }
    add(out.axis[i], dq[i], speed);
    out.speed[i] = speed;
    out.body[i] = body_at(link.body, rotation, position);
  }
  return out;
}

void SpatialDynamics::inertia_and_bias(const JointVector& q, const JointVector& dq, JointMatrix& inertia,
                                       JointVector& bias) const {
  const int n = joints_;
  Bodies at = in_base(q, dq);
  std::array<Wrench, kMaxJoints> wrench;
  Motion acceleration{Vector3d::Zero(), -gravity_};
  for (int i = 0; i < n; ++i) {
    const Motion& speed = at.speed[i];
    add(cross(speed, at.axis[i]), dq[i], acceleration);
    const Wrench momentum = at.body[i] * speed;
    wrench[i] = at.body[i] * acceleration;
    wrench[i].force += speed.turn.cross(momentum.force);
    wrench[i].moment += speed.turn.cross(momentum.moment) + speed.point.cross(momentum.force);
  }
  inertia.resize(n, n);
  bias.resize(n);
  for (int i = n - 1; i >= 0; --i) {
    bias[i] = power(at.axis[i], wrench[i]);
    const Wrench lift = at.body[i] * at.axis[i];
    for (int k = 0; k <= i; ++k) inertia(i, k) = inertia(k, i) = power(at.axis[k], lift);
    inertia(i, i) += link_[i].rotor_inertia;
    if (i == 0) break;
    add(wrench[i], wrench[i - 1]);
    Body& parent = at.body[i - 1];
    parent.mass += at.body[i].mass;
    parent.first += at.body[i].first;
    parent.inertia += at.body[i].inertia;
  }
}

void SpatialDynamics::momentum_and_force(const JointVector& q, const JointVector& dq, JointVector& momentum,
                                         JointVector& force) const {
  const Bodies at = in_base(q, dq);
  momentum.resize(joints_);
  force.resize(joints_);
  Wrench moves{Vector3d::Zero(), Vector3d::Zero()}, weighs = moves;  // of all bodies at or beyond a joint
  for (int i = joints_ - 1; i >= 0; --i) {
    add(at.body[i] * at.speed[i], moves);
    add({at.body[i].mass * gravity_, at.body[i].first.cross(gravity_)}, weighs);
    momentum[i] = power(at.axis[i], moves) + link_[i].rotor_inertia * dq[i];
    force[i] = power(cross(at.speed[i], at.axis[i]), moves) + power(at.axis[i], weighs);
  }
}

}  // namespace faultline
