// SPDX-License-Identifier: MIT
#include "lib/robot/runge_kutta.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/robot/chain.hpp"

namespace faultline {
namespace {

using Vector = JointVector;

/// Error after a second of q'' = -q in so many steps.
double error_of(int steps) {
  const auto acceleration = [](double, const Vector& q, const Vector&, Vector& ddq) { ddq = -q; };
  Vector q = Vector::Constant(1, 1.0), dq = Vector::Zero(1), a1;
  for (int i = 0; i < steps; ++i) {
    acceleration(0.0, q, dq, a1);
    runge_kutta_step(1.0 / steps, a1, acceleration, q, dq);
  }
  return std::hypot(q[0] - std::cos(1.0), dq[0] + std::sin(1.0));
}

TEST(RungeKutta, ErrorFallsWithTheFourthPowerOfTheStep) {
  EXPECT_LT(error_of(10), 1e-6);
  EXPECT_NEAR(error_of(10) / error_of(20), 16.0, 1.0);
}

TEST(RungeKutta, FollowsAnAccelerationThatDependsOnTime) {
  const double start = 2.0, h = 0.5;
  const auto acceleration = [&](double after, const Vector&, const Vector&, Vector& ddq) {
    ddq = Vector::Constant(2, 6.0 * (start + after));
  };
  Vector q = Vector::Constant(2, 8.0), dq = Vector::Constant(2, 12.0), a1;  // q = t^3
  acceleration(0.0, q, dq, a1);
  runge_kutta_step(h, a1, acceleration, q, dq);
  EXPECT_NEAR(q[1], 2.5 * 2.5 * 2.5, 1e-12);
  EXPECT_NEAR(dq[1], 3.0 * 2.5 * 2.5, 1e-12);
}

}  // namespace
}  // namespace faultline
