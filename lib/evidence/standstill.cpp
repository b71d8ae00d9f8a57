// SPDX-License-Identifier: MIT
#include "lib/evidence/standstill.hpp"

#include <algorithm>
#include <cmath>

#include "lib/robot/dynamics.hpp"

namespace faultline {
namespace {

constexpr double kStill = 0.05;            // of the usual velocity: slower is no motion
constexpr double kMoving = 0.2;            // of the usual velocity: a joint so fast was moving at the onset
constexpr double kShortestStand_s = 0.15;  // a joint that turns round stands for less
constexpr int kFewestStanding = 4;         // samples
constexpr double kLeastWay = 1e-3;         // of the healthy range: the resolution of a travelled distance

double position(const FollowedSample& sample, int joint) { return sample.posterior.mean[joint]; }
double velocity(const FollowedSample& sample, int joints, int joint) {
  return sample.posterior.mean[joints + joint];
}

bool stands(const MotionModel& model, const FollowedSample& sample, int joint) {
  return std::abs(velocity(sample, model.joints(), joint)) < kStill * model.velocity_scale[joint];
}

bool is_in_range(const MotionModel& model, const FollowedSample& sample, int joint) {
  const double q = position(sample, joint);
  return !sample.pressed[joint] && q > model.q_low[joint] && q < model.q_high[joint];
}

/// Torque of gravity on the joint where this sample has the robot.
double gravity_at(const MotionModel& model, const FollowedSample& sample, int joint) {
  JointVector<double> q(model.joints());
  for (int j = 0; j < model.joints(); ++j) q[j] = position(sample, j);
  return gravity_torque(model.chain, q)[joint];
}

double inertia_at(const MotionModel& model, const FollowedSample& sample, int joint) {
  JointVector<double> q(model.joints());
  for (int j = 0; j < model.joints(); ++j) q[j] = position(sample, j);
  return inertia_matrix(model.chain, q)(joint, joint);
}

constexpr double kHeldUp = 2.0;   // times Coulomb friction: a weight so large moves a joint that is free,
constexpr double kDriven = 2.0;   // and a torque so large one that is driven
constexpr double kStopped = 3.0;  // times the energy that friction and weight take: a free joint runs on

}  // namespace

Standstill standstill_of(const MotionModel& model, const History& history, int joint, std::int64_t onset,
                         std::int64_t now) {
  const std::int64_t before = std::max(onset - 1, history.first());
  std::int64_t first = now + 1;
  while (first > onset && stands(model, history[first - 1], joint) &&
         is_in_range(model, history[first - 1], joint))
    --first;
  Standstill out;
  if (now + 1 - first < kFewestStanding || history[now].time - history[first].time < kShortestStand_s)
    return out;
  const double friction = model.priors.coulomb_increase[joint];
  for (std::int64_t k = first; k <= now; ++k) {
    const double gravity = gravity_at(model, history[k], joint);
    out.drive += std::abs(history[k].torque[joint] - gravity);
    out.weight += std::abs(gravity);
  }
  const double count = static_cast<double>(now + 1 - first) * friction;
  out.lasts_s = history[now].time - history[first].time;
  out.drive /= count;
  const double mean_weight = out.weight / static_cast<double>(now + 1 - first);
  out.weight /= count;
  const double way = position(history[now], joint) - position(history[before], joint);
  const double speed = std::abs(velocity(history[before], model.joints(), joint));
  if (speed > kMoving * model.velocity_scale[joint]) {
    const double range = model.q_high[joint] - model.q_low[joint];
    const double taken = (friction + model.chain.friction[joint].viscous * speed + mean_weight) *
                         std::max(std::abs(way), kLeastWay * range);
    out.braked = 0.5 * inertia_at(model, history[before], joint) * speed * speed / taken;
  }
  // What gravity asks of the drive points against the way that it pulls the joint.
  if (way * gravity_at(model, history[now], joint) < 0.0) out.weight = 0.0;
  return out;
}

bool is_held(const Standstill& joint, bool torque_flows) {
  if (!(joint.lasts_s > 0.0)) return false;
  return (torque_flows && joint.drive > kDriven) || joint.weight > kHeldUp || joint.braked > kStopped;
}

}  // namespace faultline
