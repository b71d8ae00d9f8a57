// SPDX-License-Identifier: MIT
#include "lib/robot/extra_torque.hpp"

#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {

void add_extra_torque(const Chain& chain, const JointVector& q, const JointVector& dq, JointVector& torque) {
  for (const Ripple& r : chain.ripples) {
    const auto [s, c] = elementary::sin_cos(r.rate * q[r.joint]);
    torque[r.joint] += r.cosine * c + r.sine * s;
  }
  for (const SharedDrive& f : chain.shared_drives) {
    double speed = 0.0;
    for (int i = 0; i < chain.joints(); ++i) speed += f.along[i] * dq[i];
    const double drag = f.viscous * speed + f.coulomb * elementary::tanh(speed / f.width);
    for (int i = 0; i < chain.joints(); ++i) torque[i] += f.along[i] * drag;
  }
}

void add_shared_rotors(const Chain& chain, const JointVector& ddq, JointVector& torque) {
  for (const SharedDrive& drive : chain.shared_drives) {
    double rate = 0.0;
    for (int i = 0; i < chain.joints(); ++i) rate += drive.along[i] * ddq[i];
    for (int i = 0; i < chain.joints(); ++i) torque[i] += drive.along[i] * drive.rotor_inertia * rate;
  }
}

void add_shared_rotors(const Chain& chain, JointMatrix& inertia) {
  for (const SharedDrive& drive : chain.shared_drives)
    for (int i = 0; i < chain.joints(); ++i)
      for (int k = 0; k < chain.joints(); ++k)
        inertia(i, k) += drive.along[i] * drive.along[k] * drive.rotor_inertia;
}

double load_friction(const Friction& f, double dq, double carried) {
  using std::abs;
  return f.load == 0.0 ? 0.0 : f.load * abs(carried) * elementary::tanh(dq / f.width);
}

double carried_torque(double lost, double torque) {
  return torque / (torque > 0.0 ? 1.0 + lost : 1.0 - lost);
}

double carried_torque(const Friction& f, double dq, double torque) {
  if (f.load == 0.0) return torque;
  return carried_torque(f.load * elementary::tanh(dq / f.width), torque);
}

}  // namespace faultline
