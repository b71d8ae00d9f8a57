// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/chain.hpp"

/// Torques beside rigid-body torque and the friction of single joints: ripples, shared drives, load friction.
namespace faultline {

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
