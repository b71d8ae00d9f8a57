// SPDX-License-Identifier: MIT
#include "lib/residual/physics_step.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lib/core/random.hpp"
#include "lib/residual/transitions.hpp"
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

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Standard deviations that are added to the logged starts, as shares of half their range.
constexpr double kMotionSpread = 0.3, kTorqueSpread = 0.4;
constexpr std::uint64_t kPatternSeed = 1;

VectorXd half_range(const MatrixXd& values) {
  return 0.5 * (values.rowwise().maxCoeff() - values.rowwise().minCoeff());
}

VectorXd scattered(const VectorXd& centre, const VectorXd& half, double spread, Random& random) {
  VectorXd out = centre;
  for (Eigen::Index j = 0; j < out.size(); ++j) out[j] += spread * half[j] * random.normal();
  return out;
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

Transitions twin_transitions(const Transitions& logged, const TransitionShape& shape, const Chain& chain,
                             int count) {
  const VectorXd q_half = half_range(logged.q), dq_half = half_range(logged.dq),
                 tau_half = half_range(logged.mean_tau);
  const FastDynamics robot(chain);
  Random random(kPatternSeed);
  TransitionReservoir pool(std::max(count, 1), kPatternSeed);
  Transitions one = logged;  // column 0 holds the current transition
  for (int i = 0; i < count; ++i) {
    const int origin = static_cast<int>(random.below(logged.count()));
    one.duration[0] = shape.step_s;
    one.q.col(0) = scattered(logged.q.col(origin), q_half, kMotionSpread, random);
    one.dq.col(0) = scattered(logged.dq.col(origin), dq_half, kMotionSpread, random);
    one.mean_tau.col(0) = scattered(logged.mean_tau.col(origin), tau_half, kTorqueSpread, random);
    one.tau.col(0) = one.mean_tau.col(0) + logged.tau.col(origin) - logged.mean_tau.col(origin);
    const JointState end =
        physics_step(robot, {one.q.col(0), one.dq.col(0)}, one.mean_tau.col(0), shape.step_s);
    if (!end.q.allFinite() || !end.dq.allFinite()) continue;
    one.next_q.col(0) = end.q;
    one.next_dq.col(0) = end.dq;
    pool.offer(one, 0);
  }
  return pool.drawn();
}

}  // namespace faultline
