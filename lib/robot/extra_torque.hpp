// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/robot/chain.hpp"

/// Torques that neither rigid bodies nor the friction of one joint alone give.
namespace faultline {

/// Adds ripples and the friction of drives that joints share.
template <typename S>
void add_extra_torque(const Chain<S>& chain, const JointVector<S>& q, const JointVector<S>& dq,
                      JointVector<S>& torque) {
  for (const Ripple& r : chain.ripples) {
    const auto [s, c] = elementary::sin_cos(S(r.rate * q[r.joint]));
    torque[r.joint] += r.cosine * c + r.sine * s;
  }
  for (const SharedDrive& f : chain.shared_drives) {
    S speed(0.0);
    for (int i = 0; i < chain.joints(); ++i) speed += f.along[i] * dq[i];
    const S drag = f.viscous * speed + f.coulomb * elementary::tanh(speed / f.width);
    for (int i = 0; i < chain.joints(); ++i) torque[i] += f.along[i] * drag;
  }
}

/// Adds the torque that rotors of drives which joints share take at the accelerations `ddq`.
template <typename S>
void add_shared_rotors(const Chain<S>& chain, const JointVector<S>& ddq, JointVector<S>& torque) {
  for (const SharedDrive& drive : chain.shared_drives) {
    S rate(0.0);
    for (int i = 0; i < chain.joints(); ++i) rate += drive.along[i] * ddq[i];
    for (int i = 0; i < chain.joints(); ++i) torque[i] += drive.along[i] * drive.rotor_inertia * rate;
  }
}

/// Adds their inertia to M.
template <typename S>
void add_shared_rotors(const Chain<S>& chain, JointMatrix<S>& inertia) {
  for (const SharedDrive& drive : chain.shared_drives)
    for (int i = 0; i < chain.joints(); ++i)
      for (int k = 0; k < chain.joints(); ++k)
        inertia(i, k) += drive.along[i] * drive.along[k] * drive.rotor_inertia;
}

/// Friction that grows with the load: what a gear loses that carries `carried` = M ddq + h + G.
template <typename S>
S load_friction(const Friction<S>& f, const S& dq, const S& carried) {
  using std::abs;
  return f.load == S(0.0) ? S(0.0) : f.load * abs(carried) * elementary::tanh(dq / f.width);
}

/// What a gear carries on of `torque` that loses the share `lost` of what it carries; a share below zero is
/// of motion backwards.
template <typename S>
S carried_torque(const S& lost, const S& torque) {
  return torque / (torque > S(0.0) ? S(1.0) + lost : S(1.0) - lost);
}

/// The same at the velocity `dq`; `torque` is the drive's less all other friction.
template <typename S>
S carried_torque(const Friction<S>& f, const S& dq, const S& torque) {
  if (f.load == S(0.0)) return torque;
  return carried_torque<S>(f.load * elementary::tanh(dq / f.width), torque);
}

}  // namespace faultline
