// SPDX-License-Identifier: MIT
#pragma once

#include "lib/learn/twin.hpp"
#include "tests/support/hand_made_motion.hpp"

namespace faultline {

inline constexpr double kMass = 2.0, kGravity = 9.81;

/// A vertical slide of 2 kg whose parameters are known exactly and whose torque is held over a sample.
inline Robot exact_slide() {
  Robot robot = preset_robot("P");
  robot = with_masses_and_lengths(robot, {kMass}, {0.0});
  robot.chain.friction = {{4.0, 1.5, 0.0, 0.01}};
  robot.log.torque_between_samples = TorqueTiming::held;
  robot.torque_phi = 0.0;
  return robot;
}

/// The same without friction: what a fault adds to the momentum is the fault alone.
inline Robot slide_without_friction() {
  Robot robot = exact_slide();
  robot.chain.friction[0] = {};
  return robot;
}

/// What identification would say of a robot whose parameters are known exactly.
inline Identification exact_identification(Robot robot) {
  robot.log.torque_between_samples = TorqueTiming::held;
  Identification id;
  id.robot = robot;
  id.space = parameter_space(robot);
  id.estimate = parameters_of(id.space, robot.chain, 0.0);
  id.covariance = Eigen::MatrixXd::Zero(id.estimate.size(), id.estimate.size());
  id.q_noise.assign(static_cast<std::size_t>(robot.joints()), 0.0);
  id.dq_noise = id.q_noise;
  return id;
}

/// A twin with all it points to.
struct TwinWorld {
  Identification identification;
  UsualMotion motion;
  Twin twin;

  explicit TwinWorld(const Robot& robot = exact_slide(), double period_s = 0.01)
      : identification(exact_identification(robot)), motion(hand_made_motion(robot)) {
    twin = {&identification, &motion, DayDifferences::none(robot.joints()), period_s, true};
  }
  TwinWorld(const TwinWorld&) = delete;

  TwinRun run(FaultKind kind, std::uint64_t seed, Joint joint = 1_joint) const {
    return twin_run(twin, {kind, kind == FaultKind::none ? Joint() : joint}, seed);
  }
  double range(int j = 0) const { return motion.q_high[j] - motion.q_low[j]; }
};

/// First row at or after a time.
inline int row_at(const Log& log, double time_s) {
  int row = 0;
  while (row < log.rows() && log.time[row] < time_s) ++row;
  return row;
}

}  // namespace faultline
