// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lib/simulate/simulate.hpp"
#include "tests/simulate/short_runs.hpp"

/// Whole runs of robots whose gears give way.
namespace faultline {
namespace {

const std::vector<double> kMotors = {1.5, 0.6, 8.0};  // kg m^2 and kg, at the joints

Robot with_rotors() {
  Robot robot = industrial();
  robot.chain.rotor_inertia = kMotors;
  return robot;
}

SimulationSpec sprung(double stiffness, double duration_s = 2.0) {
  SimulationSpec spec = short_run(duration_s);
  spec.machine.gears = {.stiffness = std::vector<double>(3, stiffness),
                        .damping = std::vector<double>(3, 1e-4 * stiffness),
                        .motor_inertia = kMotors};
  return spec;
}

double farthest(const JointSignals& a, const JointSignals& b) {
  double most = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j)
    for (std::size_t k = 0; k < a[j].size(); ++k) most = std::max(most, std::abs(a[j][k] - b[j][k]));
  return most;
}

TEST(GearedRuns, VeryStiffGearsMoveLikeRigidGears) {
  const Log rigid = simulate(with_rotors(), short_run(2.0)).log;
  const Log stiff = simulate(industrial(), sprung(1e7)).log;
  const Log softer = simulate(industrial(), sprung(1e5)).log;
  EXPECT_LT(farthest(rigid.q, stiff.q), 1e-6);
  EXPECT_LT(farthest(rigid.dq, stiff.dq), 1e-3);
  EXPECT_LT(farthest(rigid.tau, stiff.tau), 0.1);
  EXPECT_GT(farthest(rigid.q, softer.q), 5.0 * farthest(rigid.q, stiff.q));
}

TEST(GearedRuns, LoadFrictionOfVeryStiffGearsActsLikeThatOfRigidGears) {
  Robot robot = industrial(), rigid_robot = with_rotors();
  for (int j = 0; j < 3; ++j) robot.chain.friction[j].load = rigid_robot.chain.friction[j].load = 0.1;
  const Log rigid = simulate(rigid_robot, short_run(2.0)).log;
  EXPECT_LT(farthest(rigid.q, simulate(robot, sprung(1e7)).log.q), 1e-5);
}

TEST(GearedRuns, MotorsOfRigidGearsActLikeRotors) {
  SimulationSpec spec = short_run(1.0);
  spec.machine.gears.motor_inertia = kMotors;
  EXPECT_EQ(simulate(industrial(), spec).log.q, simulate(with_rotors(), short_run(1.0)).log.q);
}

TEST(GearedRuns, TheStepIsShortEnoughForSpringsAndPlay) {
  SimulationSpec spec = sprung(2e4);
  spec.machine.gears.play = {3e-4, 3e-4, 5e-5};
  const Log usual = simulate(industrial(), spec).log;
  spec.max_step_s = 2e-5;
  const Log exact = simulate(industrial(), spec).log;
  EXPECT_LT(farthest(usual.q, exact.q), 2e-5);
}

TEST(GearedRuns, TheEncoderReadsTheMotor) {
  SimulationSpec spec = sprung(2e4);
  spec.motion.points = {{0.0, 0.0, -0.1}};
  const Log log = simulate(industrial(), spec).log;
  for (int k = 0; k < log.rows(); k += 100) {
    EXPECT_NEAR(log.q[2][k], -0.1, 1e-7) << "though its link hangs 1.2 mm lower";
    EXPECT_NEAR(log.tau[2][k], 2.5 * 9.81, 1e-3);
  }
}

TEST(GearedRuns, AFaultChangesNothingBeforeItsOnset) {
  SimulationSpec spec = sprung(2e4);
  const Log healthy = simulate(industrial(), spec, 2).log;
  spec.faults = {{FaultKind::free_swinging, 2_joint, 1.2345}};
  const Log faulty = simulate(industrial(), spec, 2).log;
  for (int k = 0; k <= 1234; ++k) ASSERT_EQ(healthy.q[1][k], faulty.q[1][k]) << k;
  EXPECT_NE(healthy.q[1][1300], faulty.q[1][1300]);
}

}  // namespace
}  // namespace faultline
