// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "lib/core/random.hpp"
#include "lib/log/log.hpp"

namespace faultline {

/// A log without torque: a stepper behind a position loop, whose speed follows what is asked for as fast as a
/// limit of its acceleration allows. While it stalls it stands, and the steps are lost.
struct SteppedJoint {
  double period_s = 0.01;
  double gain = 8.0;           ///< 1/s, of the position loop
  double acceleration = 20.0;  ///< rad/s^2, the limit
  double noise = 2e-4;         ///< rad, of the encoder; a hundred times that of the speed
  double stall_from_s = 1e9, stall_to_s = 1e9;
  bool counts_steps = false;  ///< the position is of a counter behind the stall: offset for good
  std::uint64_t seed = 1;

  Log log(double duration_s) const {
    Random random(seed);
    Log out;
    out.q.resize(1), out.dq.resize(1), out.q_ref.resize(1), out.dq_ref.resize(1);
    const double phase = 0.7 * static_cast<double>(seed);
    double q = std::sin(phase), dq = 1.3 * std::cos(phase) + 0.93, lost = 0.0;
    for (int k = 0; k * period_s < duration_s; ++k) {
      const double t = k * period_s;
      const double q_ref = std::sin(1.3 * t + phase) + 0.3 * std::sin(3.1 * t);
      const double dq_ref = 1.3 * std::cos(1.3 * t + phase) + 0.3 * 3.1 * std::cos(3.1 * t);
      const bool stalls = t >= stall_from_s && t < stall_to_s;
      out.time.push_back(t);
      out.q[0].push_back(q - lost + noise * random.normal());
      out.dq[0].push_back((stalls ? 0.0 : dq) + 100.0 * noise * random.normal());
      out.q_ref[0].push_back(q_ref), out.dq_ref[0].push_back(dq_ref);
      const double wanted = dq_ref + gain * (q_ref - q + (counts_steps ? 0.0 : lost));
      dq += std::clamp(wanted - dq, -acceleration * period_s, acceleration * period_s);
      q += period_s * dq;
      if (stalls) lost += period_s * dq;
    }
    return out;
  }
};

}  // namespace faultline
