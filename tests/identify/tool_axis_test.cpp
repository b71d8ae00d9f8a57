// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/core/random.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/simulate/simulate.hpp"
#include "tests/robot/assorted_chains.hpp"

/// Four axes whose last turns a tool with its centre of mass off the axis: what the tool does to the arm
/// depends on the length of the second link, which nobody states.
namespace faultline {
namespace {

using Vector = JointVector;

constexpr double kFirst_m = 0.25, kSecond_m = 0.2;

Robot truth() {
  Robot robot = preset_robot("RRPR");
  robot = with_masses_and_lengths(robot, {3.0, 2.0, 0.7, 0.0}, {kFirst_m, kSecond_m, 0.0, 0.0});
  robot.chain.links[3] =
      general_body(0.6, {0.05, 0.02, -0.05}, Eigen::Vector3d(1e-3, 1e-3, 4e-3).asDiagonal());
  robot.chain.friction = {
      {0.6, 0.8, 0.0, 0.03}, {0.4, 0.5, 0.0, 0.03}, {5.0, 2.0, 0.0, 0.01}, {0.02, 0.05, 0.0, 0.05}};
  return robot;
}

const Identification& found() {
  static const Identification id = [] {
    SimulationSpec spec;
    spec.duration_s = 12.0;
    spec.sample_period_s = spec.control_period_s = 0.002;
    spec.motion.low = {-2.2, -2.2, -0.2, -3.0};
    spec.motion.high = {2.2, 2.2, 0.0, 3.0};
    spec.motion.move_min_s = 0.6;
    spec.motion.move_max_s = 1.1;
    spec.noise.q = {1e-4, 1e-4, 2e-5, 2e-4};
    spec.noise.dq = {5e-3, 5e-3, 1e-3, 1e-2};
    MemorySource source(simulate(truth(), spec, 301).log, "log");
    LogSource* logs[] = {&source};
    Robot robot = preset_robot("RRPR");
    robot.known["l1"] = {kFirst_m, 0.0};
    robot.log.torque_between_samples = TorqueTiming::held;
    return identify(logs, robot);
  }();
  return id;
}

TEST(IdentifyToolAxis, TheLengthBeforeTheToolIsIdentified) {
  EXPECT_NEAR(found().robot.chain.length[1], kSecond_m, 0.002 * kSecond_m);
}

TEST(IdentifyToolAxis, TheIdentifiedRobotWithAnEccentricToolHasTheTrueTorques) {
  const Robot robot = truth();
  Random random(80);
  Vector worst = Vector::Zero(4), largest = Vector::Zero(4);
  for (int k = 0; k < 100; ++k) {
    const Vector q = draw(random, 4, 2.0), dq = draw(random, 4, 2.0), ddq = draw(random, 4, 5.0);
    const Vector tau = inverse_dynamics(robot.chain, q, dq, ddq);
    worst = worst.cwiseMax((inverse_dynamics(found().robot.chain, q, dq, ddq) - tau).cwiseAbs());
    largest = largest.cwiseMax(tau.cwiseAbs());
  }
  for (int j = 0; j < 4; ++j) EXPECT_LT(worst[j], 0.01 * largest[j]) << j + 1;
}

}  // namespace
}  // namespace faultline
