// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>

#include "lib/robot/dynamics.hpp"

/// Quantities of a chain that only tests compare with: motion under torques, momentum, energies, the tip.
namespace faultline {

/// h(q, dq) + G(q): Coriolis, centrifugal and gravity torque.
inline JointVector bias_torque(const Chain& chain, const JointVector& q, const JointVector& dq) {
  const JointVector zero = JointVector::Zero(chain.joints());
  return rigid_body_torque(chain, q, dq, zero, chain.gravity);
}

inline JointVector gravity_torque(const Chain& chain, const JointVector& q) {
  const JointVector zero = JointVector::Zero(chain.joints());
  return rigid_body_torque(chain, q, zero, zero, chain.gravity);
}

/// ddq = M^-1 (tau - h - G - F).
inline JointVector forward_dynamics(const Chain& chain, const JointVector& q, const JointVector& dq,
                                    const JointVector& tau) {
  JointVector drag = friction_torque(chain, dq);
  add_extra_torque(chain, q, dq, drag);
  JointVector net = tau - drag;
  for (int i = 0; i < chain.joints(); ++i) net[i] = carried_torque(chain.friction[i], dq[i], net[i]);
  net -= bias_torque(chain, q, dq);
  return inertia_matrix(chain, q).ldlt().solve(net);
}

/// p = M(q) dq.
inline JointVector momentum(const Chain& chain, const JointVector& q, const JointVector& dq) {
  return inertia_matrix(chain, q) * dq;
}

inline double kinetic_energy(const Chain& chain, const JointVector& q, const JointVector& dq) {
  return 0.5 * dq.dot(momentum(chain, q, dq));
}

/// Potential energy in the gravity field; zero if every centre of mass is at the base's origin.
inline double potential_energy(const Chain& chain, const JointVector& q) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double energy = 0.0;
  for (int i = 0; i < chain.joints(); ++i) {
    const auto pose = link_pose(chain, i, q[i]);
    position += rotation * pose.position;
    rotation = (rotation * pose.rotation).eval();
    const Eigen::Vector3d moment = rotation * chain.links[i].first_moment + chain.links[i].mass * position;
    energy -= chain.gravity.dot(moment);
  }
  return energy;
}

/// Position of the end of the last link in the base frame, m.
inline Eigen::Vector3d tip_position(const Chain& chain, const JointVector& q) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (int i = 0; i < chain.joints(); ++i) {
    const auto pose = link_pose(chain, i, q[i]);
    position += rotation * pose.position;
    rotation = (rotation * pose.rotation).eval();
  }
  const int last = chain.joints() - 1;
  const Eigen::Vector3d& along = chain.geometry[last].direction;
  const Eigen::Vector3d direction = along.isZero() ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : along;
  if (chain.geometry[last].kind == AxisKind::revolute)
    position += rotation * (chain.length[last] * direction);
  return position;
}

}  // namespace faultline
