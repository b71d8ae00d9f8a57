// SPDX-License-Identifier: MIT
#include "lib/robot/dynamics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

JointVector draw(Random& random, int n, double scale) {
  JointVector v(n);
  for (int i = 0; i < n; ++i) v[i] = random.uniform(-scale, scale);
  return v;
}

TEST(Dynamics, ScaraEqualsTheClosedForm) {
  const double m1 = 1.3, m2 = 0.8, m3 = 0.5, l1 = 0.9, l2 = 0.7, g = 9.81;
  Robot robot = preset_robot("RRP");
  robot = with_masses_and_lengths(robot, {m1, m2, m3}, {l1, l2, 0.0});
  const double a = l1 * l1 * (m1 / 3 + m2 + m3), b = l2 * l2 * (m2 / 3 + m3), c = l1 * l2 * (m2 / 2 + m3);
  Random random(3);
  for (int k = 0; k < 50; ++k) {
    const auto q = draw(random, 3, 2.0), dq = draw(random, 3, 3.0), ddq = draw(random, 3, 5.0);
    const double c2 = std::cos(q[1]), s2 = std::sin(q[1]);
    const auto tau = inverse_dynamics(robot.chain, q, dq, ddq);
    EXPECT_NEAR(
        tau[0],
        (a + b + 2 * c * c2) * ddq[0] + (b + c * c2) * ddq[1] - c * s2 * (2 * dq[0] * dq[1] + dq[1] * dq[1]),
        1e-12);
    EXPECT_NEAR(tau[1], (b + c * c2) * ddq[0] + b * ddq[1] + c * s2 * dq[0] * dq[0], 1e-12);
    EXPECT_NEAR(tau[2], m3 * (ddq[2] + g), 1e-12);
  }
}

}  // namespace
}  // namespace faultline
