// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "lib/core/random.hpp"
#include "lib/log/log.hpp"

namespace faultline::testing {

/// A joint whose gear is a spring between drive and link; the encoder sits on the drive.
struct TwoMassJoint {
  double drive_inertia = 0.3, link_inertia = 1.2;  ///< kg m^2
  double stiffness = 6000.0;                       ///< N m/rad
  double damping = 2.0;                            ///< N m s/rad, of the spring
  double fv = 0.8, fc = 1.0, width = 0.02;         ///< of the drive

  double inertia() const { return drive_inertia + link_inertia; }
};

/// A sum of sines up to 5 Hz followed by PD on the drive, torque held over a row; white noise.
inline Log simulate_two_mass(const TwoMassJoint& joint, double duration_s, double period_s) {
  constexpr double kBandwidth = 15.0, kStep_s = 5e-5;
  Random random(5);
  double phase[4];
  for (double& p : phase) p = random.uniform(0.0, 6.28);
  constexpr double kRate[] = {3.0, 7.3, 15.1, 31.0}, kReach[] = {0.6, 0.25, 0.08, 0.02};
  double q[2] = {}, dq[2] = {};  // drive, link
  Log log;
  log.q.resize(1);
  log.dq.resize(1);
  log.tau.resize(1);
  for (int row = 0; row * period_s < duration_s; ++row) {
    const double t = row * period_s;
    double r = 0.0, dr = 0.0;
    for (int i = 0; i < 4; ++i) {
      r += kReach[i] * std::sin(kRate[i] * t + phase[i]);
      dr += kReach[i] * kRate[i] * std::cos(kRate[i] * t + phase[i]);
    }
    const double tau =
        joint.inertia() * (kBandwidth * kBandwidth * (r - q[0]) + 2.0 * kBandwidth * (dr - dq[0]));
    log.time.push_back(t);
    log.q[0].push_back(q[0] + 2e-5 * random.normal());
    log.dq[0].push_back(dq[0] + 2e-3 * random.normal());
    log.tau[0].push_back(tau);
    const auto steps = static_cast<int>(std::lround(period_s / kStep_s));
    for (int i = 0; i < steps; ++i) {
      const double spring = joint.stiffness * (q[0] - q[1]) + joint.damping * (dq[0] - dq[1]);
      const double friction = joint.fv * dq[0] + joint.fc * std::tanh(dq[0] / joint.width);
      dq[0] += kStep_s * (tau - friction - spring) / joint.drive_inertia;
      dq[1] += kStep_s * spring / joint.link_inertia;
      q[0] += kStep_s * dq[0];
      q[1] += kStep_s * dq[1];
    }
  }
  return log;
}

}  // namespace faultline::testing
