// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/robot/chain.hpp"
#include "lib/robot/extra_torque.hpp"
#include "lib/robot/link_pose.hpp"

/// Rigid-body dynamics of a chain: M(q) ddq + h(q, dq) + G(q) + F(dq) = tau. Templated on the scalar, so that
/// Ceres Jets run through it. Recursive Newton-Euler for inverse dynamics, composite rigid bodies for M
/// (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapters 5 and 6).
namespace faultline {

/// Rigid-body torque M(q) ddq + h(q, dq) + G(q), rotors included, without friction.
template <typename S>
JointVector<S> rigid_body_torque(const Chain<S>& chain, const JointVector<S>& q, const JointVector<S>& dq,
                                 const JointVector<S>& ddq, const Eigen::Vector3d& gravity) {
  const int n = chain.joints();
  std::array<detail::LinkPose<S>, kMaxJoints> pose;
  std::array<Vector3<S>, kMaxJoints> force, moment;
  Vector3<S> omega = Vector3<S>::Zero(), alpha = Vector3<S>::Zero();
  Vector3<S> acceleration = -gravity.template cast<S>();
  for (int i = 0; i < n; ++i) {
    const JointGeometry& joint = chain.geometry[i];
    const Vector3<S> axis = joint.axis.template cast<S>();
    pose[i] = detail::link_pose(chain, i, q[i]);
    const Matrix3<S> to_link = pose[i].rotation.transpose();
    const Vector3<S>& p = pose[i].position;
    acceleration = (to_link * (acceleration + alpha.cross(p) + omega.cross(omega.cross(p)))).eval();
    omega = (to_link * omega).eval();
    alpha = (to_link * alpha).eval();
    if (joint.kind == AxisKind::revolute) {
      alpha += axis * ddq[i] + omega.cross(axis) * dq[i];
      omega += axis * dq[i];
    } else {
      acceleration += axis * ddq[i] + S(2.0) * omega.cross(axis) * dq[i];
    }
    const LinkInertia<S>& link = chain.links[i];
    force[i] = acceleration * link.mass + alpha.cross(link.first_moment) +
               omega.cross(omega.cross(link.first_moment));
    moment[i] =
        link.inertia * alpha + omega.cross(link.inertia * omega) + link.first_moment.cross(acceleration);
  }
  JointVector<S> tau(n);
  for (int i = n - 1; i >= 0; --i) {
    const JointGeometry& joint = chain.geometry[i];
    const Vector3<S> axis = joint.axis.template cast<S>();
    tau[i] = axis.dot(joint.kind == AxisKind::revolute ? moment[i] : force[i]);
    if (!chain.rotor_inertia.empty()) tau[i] += chain.rotor_inertia[i] * ddq[i];
    if (i == 0) break;
    const Vector3<S> force_in_parent = pose[i].rotation * force[i];
    moment[i - 1] += pose[i].rotation * moment[i] + pose[i].position.cross(force_in_parent);
    force[i - 1] += force_in_parent;
  }
  if (!chain.shared_drives.empty()) add_shared_rotors(chain, ddq, tau);
  return tau;
}

template <typename S>
JointVector<S> friction_torque(const Chain<S>& chain, const JointVector<S>& dq) {
  using std::abs;
  JointVector<S> torque(chain.joints());
  for (int i = 0; i < chain.joints(); ++i) {
    const Friction<S>& f = chain.friction[i];
    torque[i] = f.viscous * dq[i] + f.coulomb * elementary::tanh(dq[i] / f.width) + f.offset +
                f.bend * elementary::tanh(dq[i] / f.bend_width) + f.skew * abs(dq[i]);
  }
  return torque;
}

/// tau = M ddq + h + G + F, F with ripples and all friction.
template <typename S>
JointVector<S> inverse_dynamics(const Chain<S>& chain, const JointVector<S>& q, const JointVector<S>& dq,
                                const JointVector<S>& ddq) {
  JointVector<S> tau = rigid_body_torque(chain, q, dq, ddq, chain.gravity);
  for (int i = 0; i < chain.joints(); ++i) tau[i] += load_friction(chain.friction[i], dq[i], tau[i]);
  tau += friction_torque(chain, dq);
  add_extra_torque(chain, q, dq, tau);
  return tau;
}

/// h(q, dq) + G(q): Coriolis, centrifugal and gravity torque.
template <typename S>
JointVector<S> bias_torque(const Chain<S>& chain, const JointVector<S>& q, const JointVector<S>& dq) {
  const JointVector<S> zero = JointVector<S>::Zero(chain.joints());
  return rigid_body_torque(chain, q, dq, zero, chain.gravity);
}

template <typename S>
JointVector<S> gravity_torque(const Chain<S>& chain, const JointVector<S>& q) {
  const JointVector<S> zero = JointVector<S>::Zero(chain.joints());
  return rigid_body_torque(chain, q, zero, zero, chain.gravity);
}

/// Inertia matrix M(q), n x n, symmetric.
template <typename S>
JointMatrix<S> inertia_matrix(const Chain<S>& chain, const JointVector<S>& q) {
  const int n = chain.joints();
  std::array<detail::LinkPose<S>, kMaxJoints> pose;
  std::array<LinkInertia<S>, kMaxJoints> composite;
  for (int i = 0; i < n; ++i) {
    pose[i] = detail::link_pose(chain, i, q[i]);
    composite[i] = chain.links[i];
  }
  JointMatrix<S> m(n, n);
  for (int i = n - 1; i >= 0; --i) {
    const LinkInertia<S>& body = composite[i];
    const JointGeometry& joint = chain.geometry[i];
    const Vector3<S> axis = joint.axis.template cast<S>();
    Vector3<S> force,
        moment;  // that a unit acceleration of joint i asks of the composite body, at its origin
    if (joint.kind == AxisKind::revolute) {
      force = axis.cross(body.first_moment);
      moment = body.inertia * axis;
    } else {
      force = axis * body.mass;
      moment = body.first_moment.cross(axis);
    }
    for (int k = i;; --k) {
      const JointGeometry& other = chain.geometry[k];
      const S entry = other.axis.template cast<S>().dot(other.kind == AxisKind::revolute ? moment : force);
      m(i, k) = entry;
      m(k, i) = entry;
      if (k == 0) break;
      force = (pose[k].rotation * force).eval();
      moment = (pose[k].rotation * moment + pose[k].position.cross(force)).eval();
    }
    if (!chain.rotor_inertia.empty()) m(i, i) += chain.rotor_inertia[i];
    if (i == 0) break;
    const Matrix3<S>& r = pose[i].rotation;
    const Vector3<S>& p = pose[i].position;
    const Vector3<S> h = r * body.first_moment;
    LinkInertia<S>& parent = composite[i - 1];
    parent.inertia += r * body.inertia * r.transpose() +
                      (body.mass * p.squaredNorm() + S(2.0) * p.dot(h)) * Matrix3<S>::Identity() -
                      body.mass * p * p.transpose() - p * h.transpose() - h * p.transpose();
    parent.first_moment += h + body.mass * p;
    parent.mass += body.mass;
  }
  if (!chain.shared_drives.empty()) add_shared_rotors(chain, m);
  return m;
}

/// ddq = M^-1 (tau - h - G - F).
template <typename S>
JointVector<S> forward_dynamics(const Chain<S>& chain, const JointVector<S>& q, const JointVector<S>& dq,
                                const JointVector<S>& tau) {
  JointVector<S> drag = friction_torque(chain, dq);
  add_extra_torque(chain, q, dq, drag);
  JointVector<S> net = tau - drag;
  for (int i = 0; i < chain.joints(); ++i) net[i] = carried_torque(chain.friction[i], dq[i], net[i]);
  net -= bias_torque(chain, q, dq);
  return inertia_matrix(chain, q).ldlt().solve(net);
}

/// p = M(q) dq.
template <typename S>
JointVector<S> momentum(const Chain<S>& chain, const JointVector<S>& q, const JointVector<S>& dq) {
  return inertia_matrix(chain, q) * dq;
}

template <typename S>
S kinetic_energy(const Chain<S>& chain, const JointVector<S>& q, const JointVector<S>& dq) {
  return S(0.5) * dq.dot(momentum(chain, q, dq));
}

/// Potential energy in the gravity field, zero when every centre of mass is at the base's origin.
template <typename S>
S potential_energy(const Chain<S>& chain, const JointVector<S>& q) {
  Matrix3<S> rotation = Matrix3<S>::Identity();
  Vector3<S> position = Vector3<S>::Zero();
  S energy = S(0.0);
  for (int i = 0; i < chain.joints(); ++i) {
    const auto pose = detail::link_pose(chain, i, q[i]);
    position += rotation * pose.position;
    rotation = (rotation * pose.rotation).eval();
    const Vector3<S> moment = rotation * chain.links[i].first_moment + chain.links[i].mass * position;
    energy -= chain.gravity.template cast<S>().dot(moment);
  }
  return energy;
}

/// Position of the end of the last link in the base frame, m.
template <typename S>
Vector3<S> tip_position(const Chain<S>& chain, const JointVector<S>& q) {
  Matrix3<S> rotation = Matrix3<S>::Identity();
  Vector3<S> position = Vector3<S>::Zero();
  for (int i = 0; i < chain.joints(); ++i) {
    const auto pose = detail::link_pose(chain, i, q[i]);
    position += rotation * pose.position;
    rotation = (rotation * pose.rotation).eval();
  }
  const int last = chain.joints() - 1;
  const Eigen::Vector3d& along = chain.geometry[last].direction;
  const Eigen::Vector3d direction = along.isZero() ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : along;
  if (chain.geometry[last].kind == AxisKind::revolute)
    position += rotation * (chain.length[last] * direction.template cast<S>());
  return position;
}

}  // namespace faultline
