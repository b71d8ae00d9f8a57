// SPDX-License-Identifier: MIT
#include "lib/residual/physics_step.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/robot/runge_kutta.hpp"

namespace faultline {
namespace {

using Vector = JointVector;

/// Number of integration steps. Runge-Kutta of order 4 is stable up to rate * step = 2.78; the friction of a
/// joint reduces its velocity at the rate dF/d(dq) / M.
int substeps(const FastDynamics& robot, const JointState& start, double duration) {
  constexpr double kLongest = 0.005, kStable = 2.0, kMost = 256.0;
  JointMatrix inertia;
  Vector bias;
  robot.inertia_and_bias(start.q, start.dq, inertia, bias);
  const JointMatrix inverse = inertia.inverse();
  double rate = kStable / kLongest;
  for (int j = 0; j < robot.joints(); ++j) {
    const Friction& f = robot.chain().friction[j];
    rate = std::max(rate, inverse(j, j) * steepest(f));
  }
  return static_cast<int>(std::clamp(std::ceil(duration * rate / kStable), 1.0, kMost));
}

}  // namespace

JointState physics_step(const FastDynamics& robot, const JointState& start, const Vector& tau,
                        double duration) {
  if (!start.q.allFinite() || !start.dq.allFinite() || !tau.allFinite() || !std::isfinite(duration)) {
    const Vector nothing = Vector::Constant(robot.joints(), std::numeric_limits<double>::quiet_NaN());
    return {nothing, nothing};
  }
  const int steps = substeps(robot, start, duration);
  const double h = duration / steps;
  JointState x = start;
  const auto acceleration = [&](double, const Vector& q, const Vector& dq, Vector& ddq) {
    robot.acceleration(q, dq, tau, ddq);
  };
  Vector a1;
  for (int i = 0; i < steps; ++i) {
    robot.acceleration(x.q, x.dq, tau, a1);
    runge_kutta_step(h, a1, acceleration, x.q, x.dq);
  }
  return x;
}

}  // namespace faultline
