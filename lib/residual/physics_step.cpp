// SPDX-License-Identifier: MIT
#include "lib/residual/physics_step.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace faultline {
namespace {

using Vector = JointVector<double>;

/// Runge-Kutta of order 4 is stable up to rate * step = 2.78; the friction of a joint pulls the velocity to
/// zero at the rate dF/ddq / M.
int substeps(const FastDynamics& robot, const JointState& start, double duration) {
  constexpr double kLongest = 0.005, kStable = 2.0, kMost = 256.0;
  JointMatrix<double> inertia;
  Vector bias;
  robot.inertia_and_bias(start.q, start.dq, inertia, bias);
  const JointMatrix<double> inverse = inertia.inverse();
  double rate = kStable / kLongest;
  for (int j = 0; j < robot.joints(); ++j) {
    const Friction<double>& f = robot.chain().friction[j];
    rate = std::max(rate, inverse(j, j) * (f.viscous + f.coulomb / f.width));
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
  Vector a1, a2, a3, a4;
  for (int i = 0; i < steps; ++i) {
    robot.acceleration(x.q, x.dq, tau, a1);
    const Vector v2 = x.dq + 0.5 * h * a1;
    robot.acceleration(x.q + 0.5 * h * x.dq, v2, tau, a2);
    const Vector v3 = x.dq + 0.5 * h * a2;
    robot.acceleration(x.q + 0.5 * h * v2, v3, tau, a3);
    const Vector v4 = x.dq + h * a3;
    robot.acceleration(x.q + h * v3, v4, tau, a4);
    x.q += h / 6.0 * (x.dq + 2.0 * v2 + 2.0 * v3 + v4);
    x.dq += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  }
  return x;
}

}  // namespace faultline
