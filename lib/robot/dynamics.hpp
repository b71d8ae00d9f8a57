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

/// Adds the torque of ripples and the friction of shared drives.
void add_extra_torque(const Chain& chain, const JointVector& q, const JointVector& dq, JointVector& torque);

/// Adds the torque that the rotors of shared drives take at the accelerations `ddq`.
void add_shared_rotors(const Chain& chain, const JointVector& ddq, JointVector& torque);

/// Adds the inertia of the rotors of shared drives to M.
void add_shared_rotors(const Chain& chain, JointMatrix& inertia);

/// Returns the load friction: the torque lost in a gear that carries `carried` = M ddq + h + G.
double load_friction(const Friction& f, double dq, double carried);

/// Returns the torque that a gear passes on of the drive's `torque` if it loses the share `lost` of the
/// torque passed on; `lost` is negative in backward motion.
double carried_torque(double lost, double torque);

/// The same at the velocity `dq`; `torque` is the drive's torque less all other friction.
double carried_torque(const Friction& f, double dq, double torque);

}  // namespace faultline
