// SPDX-License-Identifier: MIT
#include "lib/simulate/mobility.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr int kPostures = 16;      // the zero posture and random ones
constexpr double kFarthest = 3.0;  // rad or m: random postures lie within this distance of zero

}  // namespace

JointVector mobility(const FastDynamics& dynamics) {
  const int n = dynamics.joints();
  Random random(1);
  JointVector most = JointVector::Zero(n), q(n), bias;
  const JointVector rest = JointVector::Zero(n);
  JointMatrix inertia;
  for (int k = 0; k < kPostures; ++k) {
    for (int i = 0; i < n; ++i) q[i] = k ? random.uniform(-kFarthest, kFarthest) : 0.0;
    dynamics.inertia_and_bias(q, rest, inertia, bias);
    const JointMatrix inverse = inertia.inverse();
    most = most.cwiseMax(inverse.diagonal());
  }
  return most;
}

double sliding_slope(const Friction& friction) {
  return friction.viscous + std::abs(friction.skew) + std::abs(friction.bend) / friction.bend_width;
}

Robot with_slow_friction(Robot robot, double slowest_s) {
  const JointVector most = mobility(FastDynamics(robot.chain));
  robot.chain.rotor_inertia.resize(robot.chain.friction.size(), 0.0);
  for (std::size_t i = 0; i < robot.chain.friction.size(); ++i) {
    const double needed = sliding_slope(robot.chain.friction[i]) * slowest_s;
    const double least = 1.0 / most[static_cast<Eigen::Index>(i)];
    robot.chain.rotor_inertia[i] += std::max(needed - least, 0.0);
  }
  return robot;
}

}  // namespace faultline
