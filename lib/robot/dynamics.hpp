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

/// Inertia matrix M(q), n x n, symmetric.
JointMatrix inertia_matrix(const Chain& chain, const JointVector& q);

}  // namespace faultline
