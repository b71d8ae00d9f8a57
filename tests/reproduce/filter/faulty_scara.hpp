// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "lib/robot/robot.hpp"

namespace faultline {

/// A three-axis SCARA with any mechanical fault, by its closed form and a fine Runge-Kutta: apart from the
/// library's dynamics. a = l1^2 (m1/3 + m2 + m3), b = l2^2 (m2/3 + m3), c = l1 l2 (m2/2 + m3).
struct FaultyScara {
  using Triple = std::array<double, 3>;
  struct State {
    Triple q{}, dq{};
  };

  double m1 = 8.0, m2 = 5.0, m3 = 2.5, l1 = 0.35, l2 = 0.3;
  Triple fv = {2.0, 1.0, 20.0}, fc = {3.0, 2.0, 8.0}, fo = {0.3, -0.2, 0.5}, width = {0.02, 0.02, 0.01};
  Triple arrives = {1.0, 1.0, 1.0};  ///< share of each drive's torque
  Triple push{};                     ///< outside torque
  int locked = -1;                   ///< joint that cannot accelerate

  Triple acceleration(const State& x, const Triple& torque) const {
    const double a = l1 * l1 * (m1 / 3.0 + m2 + m3), b = l2 * l2 * (m2 / 3.0 + m3),
                 c = l1 * l2 * (m2 / 2.0 + m3);
    const double m11 = a + b + 2.0 * c * std::cos(x.q[1]), m12 = b + c * std::cos(x.q[1]), m22 = b;
    const double s = c * std::sin(x.q[1]);
    const Triple bias = {-s * (2.0 * x.dq[0] * x.dq[1] + x.dq[1] * x.dq[1]), s * x.dq[0] * x.dq[0],
                         m3 * 9.81};
    Triple net;
    for (int j = 0; j < 3; ++j)
      net[j] = arrives[j] * torque[j] + push[j] - bias[j] - fv[j] * x.dq[j] -
               fc[j] * std::tanh(x.dq[j] / width[j]) - fo[j];
    const double lift = locked == 2 ? 0.0 : net[2] / m3;
    if (locked == 0) return {0.0, net[1] / m22, lift};
    if (locked == 1) return {net[0] / m11, 0.0, lift};
    const double determinant = m11 * m22 - m12 * m12;
    return {(m22 * net[0] - m12 * net[1]) / determinant, (m11 * net[1] - m12 * net[0]) / determinant, lift};
  }

  /// The state `dt` later, in `steps` steps of Runge-Kutta.
  State after(State x, const Triple& torque, double dt, int steps = 400) const {
    const double h = dt / steps;
    const auto moved = [](State from, const State& by, double share) {
      for (int j = 0; j < 3; ++j) from.q[j] += share * by.q[j], from.dq[j] += share * by.dq[j];
      return from;
    };
    const auto slope = [&](const State& at) { return State{at.dq, acceleration(at, torque)}; };
    for (int step = 0; step < steps; ++step) {
      const State k1 = slope(x), k2 = slope(moved(x, k1, h / 2.0)), k3 = slope(moved(x, k2, h / 2.0)),
                  k4 = slope(moved(x, k3, h));
      x = moved(moved(moved(moved(x, k1, h / 6.0), k2, h / 3.0), k3, h / 3.0), k4, h / 6.0);
    }
    return x;
  }

  /// The healthy robot as the library's chain.
  Robot robot() const {
    Robot robot = preset_robot("RRP");
    set_masses_and_lengths(robot, {m1, m2, m3}, {l1, l2, 0.0});
    for (int j = 0; j < 3; ++j) robot.chain.friction[j] = {fv[j], fc[j], fo[j], width[j]};
    return robot;
  }
};

}  // namespace faultline
