// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/chain.hpp"

/// Rigid-body dynamics of a chain: M(q) ddq + h(q, dq) + G(q) + F(dq) = tau. Recursive Newton-Euler for
/// inverse dynamics, composite rigid bodies for M (Featherstone, Rigid Body Dynamics Algorithms, 2008,
/// chapters 5 and 6).
namespace faultline {

/// Rotation by `angle` about the unit vector `axis` (Rodrigues): child coordinates to parent coordinates.
Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double angle);

/// Pose of link i's frame in the frame of link i-1.
struct LinkPose {
  Eigen::Matrix3d rotation;  ///< link i to link i-1
  Eigen::Vector3d position;  ///< origin of link i, in link i-1
};

/// Pose of link `i` of the chain in the frame of link i-1 at the position `q` of its joint.
LinkPose link_pose(const Chain& chain, int i, double q);

/// Rigid-body torque M(q) ddq + h(q, dq) + G(q), rotors included, without friction.
JointVector rigid_body_torque(const Chain& chain, const JointVector& q, const JointVector& dq,
                              const JointVector& ddq, const Eigen::Vector3d& gravity);

JointVector friction_torque(const Chain& chain, const JointVector& dq);

/// tau = M ddq + h + G + F, where F has all friction and the ripples.
JointVector inverse_dynamics(const Chain& chain, const JointVector& q, const JointVector& dq,
                             const JointVector& ddq);

/// h(q, dq) + G(q): Coriolis, centrifugal and gravity torque.
JointVector bias_torque(const Chain& chain, const JointVector& q, const JointVector& dq);

JointVector gravity_torque(const Chain& chain, const JointVector& q);

/// Inertia matrix M(q), n x n, symmetric.
JointMatrix inertia_matrix(const Chain& chain, const JointVector& q);

/// ddq = M^-1 (tau - h - G - F).
JointVector forward_dynamics(const Chain& chain, const JointVector& q, const JointVector& dq,
                             const JointVector& tau);

/// p = M(q) dq.
JointVector momentum(const Chain& chain, const JointVector& q, const JointVector& dq);

double kinetic_energy(const Chain& chain, const JointVector& q, const JointVector& dq);

/// Potential energy in the gravity field; zero if every centre of mass is at the base's origin.
double potential_energy(const Chain& chain, const JointVector& q);

/// Position of the end of the last link in the base frame, m.
Eigen::Vector3d tip_position(const Chain& chain, const JointVector& q);

}  // namespace faultline
