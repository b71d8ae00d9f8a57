// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/simulate/simulate.hpp"
#include "tests/simulate/short_runs.hpp"

namespace faultline {
namespace {

TEST(SimulateFaults, FreeSwingingJointGetsNoTorque) {
  const Robot robot = industrial();
  const SimulatedRun run = simulate(robot, with_fault(FaultKind::free_swinging, 2_joint, 1.0));
  for (int k = 1010; k < 1500; k += 70) {
    const auto needed = torque_needed(robot.chain, run.log, k);
    EXPECT_NEAR(needed[1], 0.0, 0.05);
    EXPECT_GT(std::abs(run.log.tau[1][k]), 0.2);  // commanded all the same
  }
  ASSERT_EQ(run.truth.size(), 1u);
  EXPECT_EQ(run.truth[0].onset_s, 1.0);
  EXPECT_EQ(run.truth[0].end_s, 3.0);
}

TEST(SimulateFaults, TorqueLossTakesItsShare) {
  const Robot robot = industrial();
  const SimulatedRun run = simulate(robot, with_fault(FaultKind::torque_loss, 3_joint, 1.0, 0.4));
  for (int k = 1050; k < 2900; k += 185) {
    const double applied = 0.5 * (run.log.tau[2][k] + run.log.tau[2][k - 1]);
    EXPECT_NEAR(torque_needed(robot.chain, run.log, k)[2], 0.6 * applied, 0.1);
  }
}

TEST(SimulateFaults, ALockedJointStopsAtOnceAndPassesOnItsMomentum) {
  const Robot robot = industrial();
  SimulationSpec spec = short_run();
  spec.motion.points = {{-1.0, -1.0, -0.2}, {1.0, 1.0, 0.0}};
  spec.motion.dwell_min_s = spec.motion.dwell_max_s = 0.2;
  spec.faults = {{FaultKind::locked, 2_joint, 0.8004, 2.0, 0.0, 0.0}};
  const SimulatedRun run = simulate(robot, spec);
  const auto before = row_of(run.log.dq, 800), after = row_of(run.log.dq, 801);
  ASSERT_GT(std::abs(before[1]), 0.5);
  for (int k = 801; k <= 2000; ++k) ASSERT_EQ(run.log.dq[1][k], 0.0);
  EXPECT_EQ(run.log.q[1][801], run.log.q[1][2000]);
  const auto q = row_of(run.log.q, 801);
  EXPECT_NEAR((inertia_matrix(robot.chain, q) * before)[0], (inertia_matrix(robot.chain, q) * after)[0],
              0.05);
  EXPECT_GT(std::abs(run.log.dq[1][2100]), 0.0);  // released again
}

TEST(SimulateFaults, SensorFaultsGoThroughTheFeedback) {
  const Robot robot = industrial();
  SimulationSpec spec = with_fault(FaultKind::sensor_bias, 1_joint, 1.0, 0.02);
  spec.motion.points = {{0.0, 0.0, 0.0}};
  const SimulatedRun run = simulate(robot, spec);
  EXPECT_NEAR(run.log.q[0][999], 0.0, 1e-6);
  EXPECT_NEAR(run.log.q[0][1000], 0.02, 1e-6);
  EXPECT_LT(run.log.tau[0][1000], -1.0);       // the controller corrects what it sees
  EXPECT_NEAR(run.log.q[0][2900], 0.0, 5e-3);  // and the true joint ends 0.02 off
}

TEST(SimulateFaults, StuckEncoderRepeatsItsReading) {
  SimulationSpec spec = with_fault(FaultKind::stuck_encoder, 1_joint, 1.0);
  spec.noise.q = {1e-4, 1e-4, 2e-5};
  spec.noise.dq = {5e-3, 5e-3, 1e-3};
  spec.overspeed = {8.0, 8.0, 3.0};
  const SimulatedRun run = simulate(industrial(), spec);
  ASSERT_GT(run.log.rows(), 1010);
  for (int k = 1000; k < run.log.rows(); ++k) {
    ASSERT_EQ(run.log.q[0][k], run.log.q[0][999]);
    ASSERT_EQ(run.log.dq[0][k], run.log.dq[0][999]);
  }
  EXPECT_NE(run.log.q[0][999], run.log.q[0][998]);
}

TEST(SimulateFaults, DriftGrowsWithTime) {
  SimulationSpec spec = with_fault(FaultKind::sensor_drift, 2_joint, 1.0, 0.05);
  spec.motion.points = {{0.0, 0.0, 0.0}};
  spec.controller.bandwidth_rad_s = 1e-3;  // nobody follows the drift
  const SimulatedRun run = simulate(industrial(), spec);
  EXPECT_NEAR(run.log.q[1][2000] - run.log.q[1][1000], 0.05, 1e-4);
}

TEST(SimulateFaults, FrictionIncreaseAddsToTheTorque) {
  const Robot robot = industrial();
  SimulationSpec spec = with_fault(FaultKind::friction_increase, 1_joint, 0.8, 4.0);
  spec.faults[0].viscous = 1.5;
  spec.motion.points = {{-1.0, -1.0, -0.2}, {1.0, 1.0, 0.0}};
  const SimulatedRun run = simulate(robot, spec);
  for (int k = 900; k < 1200; k += 50) {
    const double dq = run.log.dq[0][k];
    ASSERT_GT(dq, 0.1);
    const double applied = 0.5 * (run.log.tau[0][k] + run.log.tau[0][k - 1]);
    EXPECT_NEAR(applied - torque_needed(robot.chain, run.log, k)[0], 4.0 + 1.5 * dq, 0.2);
  }
}

TEST(SimulateFaults, PayloadAddsMassAtTheTip) {
  const Robot robot = industrial();
  const SimulatedRun run = simulate(robot, with_fault(FaultKind::payload_change, 3_joint, 1.0, 1.0));
  Robot loaded = industrial();
  loaded = with_masses_and_lengths(loaded, {8.0, 5.0, 3.5}, {0.35, 0.3, 0.0});
  for (int k = 1100; k < 2900; k += 180) {
    const JointVector applied = 0.5 * (row_of(run.log.tau, k) + row_of(run.log.tau, k - 1));
    EXPECT_LT((torque_needed(loaded.chain, run.log, k) - applied).cwiseAbs().maxCoeff(), 0.2);
  }
}

TEST(SimulateFaults, CollisionIsAPulseOfExternalTorque) {
  const Robot robot = industrial();
  SimulationSpec spec = with_fault(FaultKind::collision, 1_joint, 1.0, 30.0);
  spec.faults[0].end_s = 1.05;
  const SimulatedRun run = simulate(robot, spec);
  const auto missing = [&](int k) {
    const double applied = 0.5 * (run.log.tau[0][k] + run.log.tau[0][k - 1]);
    return torque_needed(robot.chain, run.log, k)[0] - applied;
  };
  EXPECT_NEAR(missing(1025), 30.0, 1.0);
  EXPECT_NEAR(missing(990), 0.0, 0.2);
  EXPECT_NEAR(missing(1060), 0.0, 0.5);
  EXPECT_EQ(run.truth.at(0).end_s, 1.05);
}

}  // namespace
}  // namespace faultline
