// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>

#include "lib/core/random.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// A log of one joint under a PD law whose drive follows the command with a lag, both known exactly.
struct DrivenJoint {
  double period_s = 0.005;
  double lag_s = 0.01;  ///< of the drive, first order
  double noise = 0.02;  ///< N m, of the measured torque
  double reading_noise =
      1e-3;               ///< rad, of the position that the controller reads; ten times that of the speed
  double by_speed = 0.0;  ///< N m s/rad that the drive gives less, as the voltage that it induces does
  double kp = 40.0, kd = 3.0;
  std::uint64_t seed = 1;
  /// N m added at a time: behind the controller, in the drive; and to what it commands.
  std::function<double(double)> in_drive = [](double) { return 0.0; };
  std::function<double(double)> in_command = [](double) { return 0.0; };
  double drive_gain_from_s = 1e9, drive_gain = 1.0;  ///< from then on the drive gives this share

  Log log(double duration_s) const {
    Random random(seed);
    Log out;
    out.q.resize(1), out.dq.resize(1), out.q_ref.resize(1), out.dq_ref.resize(1), out.tau.resize(1),
        out.tau_meas.resize(1);
    double q = 0.0, dq = 0.0, drive = 0.0;
    const double kept = std::exp(-period_s / lag_s);
    const double phase = 0.3 * static_cast<double>(seed);
    for (int k = 0; k * period_s < duration_s; ++k) {
      const double t = k * period_s;
      const double q_ref = std::sin(2.0 * t + phase) + 0.4 * std::sin(5.1 * t);
      const double dq_ref = 2.0 * std::cos(2.0 * t + phase) + 0.4 * 5.1 * std::cos(5.1 * t);
      const double read = q + reading_noise * random.normal();
      const double read_speed = dq + 10.0 * reading_noise * random.normal();
      const double command = kp * (q_ref - read) + kd * (dq_ref - read_speed) + in_command(t);
      out.time.push_back(t);
      out.q[0].push_back(read), out.dq[0].push_back(read_speed);
      out.q_ref[0].push_back(q_ref), out.dq_ref[0].push_back(dq_ref);
      out.tau[0].push_back(command);
      out.tau_meas[0].push_back(drive + noise * random.normal());
      const double wanted =
          command * (t >= drive_gain_from_s ? drive_gain : 1.0) + in_drive(t) - by_speed * dq;
      drive = wanted + kept * (drive - wanted);
      dq += period_s * (drive - 0.8 * dq) / 0.5;
      q += period_s * dq;
    }
    return out;
  }
};

inline std::function<double(double)> pulse(double begin_s, double end_s, double size) {
  return [=](double t) { return t >= begin_s && t < end_s ? size : 0.0; };
}

}  // namespace faultline
