// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/chain.hpp"

/// Torques that neither rigid bodies nor the friction of one joint alone give.
namespace faultline {

/// Adds ripples and the friction of drives that joints share.
void add_extra_torque(const Chain& chain, const JointVector& q, const JointVector& dq, JointVector& torque);

/// Adds the torque that rotors of drives which joints share take at the accelerations `ddq`.
void add_shared_rotors(const Chain& chain, const JointVector& ddq, JointVector& torque);

/// Adds their inertia to M.
void add_shared_rotors(const Chain& chain, JointMatrix& inertia);

/// Friction that grows with the load: what a gear loses that carries `carried` = M ddq + h + G.
double load_friction(const Friction& f, double dq, double carried);

/// What a gear carries on of `torque` that loses the share `lost` of what it carries; a share below zero is
/// of motion backwards.
double carried_torque(double lost, double torque);

/// The same at the velocity `dq`; `torque` is the drive's less all other friction.
double carried_torque(const Friction& f, double dq, double torque);

}  // namespace faultline
