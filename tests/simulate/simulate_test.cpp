// SPDX-License-Identifier: MIT
#include "lib/simulate/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/simulate/plant.hpp"
#include "tests/simulate/short_runs.hpp"

namespace faultline {
namespace {

TEST(Simulate, HealthyRunFollowsItsReferenceAndTheDynamics) {
  const Robot robot = industrial();
  const SimulatedRun run = simulate(robot, short_run());
  EXPECT_EQ(run.end, EndReason::complete);
  EXPECT_TRUE(run.truth.empty());
  ASSERT_EQ(run.log.rows(), 3001);
  double travelled = 0.0;
  for (int k = 1; k < run.log.rows() - 1; k += 37) {
    EXPECT_LT((row_of(run.log.q, k) - row_of(run.log.q_ref, k)).norm(), 2e-3);
    travelled += std::abs(run.log.dq[0][k]);
    const JointVector applied = 0.5 * (row_of(run.log.tau, k) + row_of(run.log.tau, k - 1));
    EXPECT_LT((torque_needed(robot.chain, run.log, k) - applied).cwiseAbs().maxCoeff(), 0.15) << "row " << k;
  }
  EXPECT_GT(travelled, 10.0);
}

TEST(Simulate, TheSameSeedGivesTheSameRunAndAnotherSeedAnotherRun) {
  SimulationSpec spec = short_run(0.5);
  spec.noise.q = {1e-4, 1e-4, 2e-5};
  spec.noise.dq = {5e-3, 5e-3, 1e-3};
  const Robot robot = industrial();
  const Log a = simulate(robot, spec, 4).log, b = simulate(robot, spec, 4).log,
            c = simulate(robot, spec, 5).log;
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.tau, b.tau);
  EXPECT_NE(a.q, c.q);
}

TEST(Simulate, AFaultChangesNothingBeforeItsOnset) {
  const Robot robot = industrial();
  SimulationSpec spec = short_run();
  spec.noise.q = {1e-4, 1e-4, 2e-5};
  const Log healthy = simulate(robot, spec, 2).log;
  spec.faults = {{FaultKind::torque_loss, 1_joint, 1.2345, 9.0, 0.5, 0.0}};
  const Log faulty = simulate(robot, spec, 2).log;
  for (int k = 0; k <= 1234; ++k) ASSERT_EQ(healthy.q[0][k], faulty.q[0][k]) << k;
  EXPECT_NE(healthy.q[0][1300], faulty.q[0][1300]);
}

TEST(Simulate, NoiseHasTheStatedSize) {
  SimulationSpec spec = short_run(5.0);
  spec.motion.points = {{0.1, 0.2, -0.1}};
  spec.noise.q = {1e-3, 2e-3, 5e-4};
  spec.noise.dq = {1e-2, 2e-2, 5e-3};
  spec.controller.bandwidth_rad_s = 0.01;  // so slack that the noise does not come back as motion
  const SimulatedRun run = simulate(industrial(), spec);
  for (int i = 0; i < 3; ++i) {
    double sum = 0.0;
    for (const double v : run.log.dq[i]) sum += v * v;
    EXPECT_NEAR(std::sqrt(sum / run.log.rows()), spec.noise.dq[i], 0.05 * spec.noise.dq[i]);
  }
}

TEST(Simulate, PositionsAreMultiplesOfTheEncoderStep) {
  SimulationSpec spec = short_run(1.0);
  spec.noise.q_resolution = {0.01, 0.01, 0.001};
  const SimulatedRun run = simulate(industrial(), spec);
  for (const double v : run.log.q[0]) EXPECT_NEAR(v / 0.01, std::round(v / 0.01), 1e-9);
}

TEST(Simulate, TorqueLimitHolds) {
  SimulationSpec spec = short_run();
  spec.motion.profile = MotionProfile::step;
  spec.torque_limit = {5.0, 5.0, 40.0};
  const SimulatedRun run = simulate(industrial(), spec);
  double most = 0.0;
  for (const double v : run.log.tau[0]) most = std::max(most, std::abs(v));
  EXPECT_EQ(most, 5.0);
}

TEST(Simulate, AFreedVerticalJointRestsOnItsStop) {
  SimulationSpec spec = with_fault(FaultKind::free_swinging, 3_joint, 0.5);
  spec.stops.low = {-3.0, -3.0, -0.4};
  spec.stops.high = {3.0, 3.0, 0.1};
  const SimulatedRun run = simulate(industrial(), spec);
  EXPECT_EQ(run.end, EndReason::complete);
  EXPECT_NEAR(run.log.q[2].back(), -0.4, 0.01);
  EXPECT_NEAR(run.log.dq[2].back(), 0.0, 1e-3);
}

TEST(Simulate, OverspeedEndsTheLog) {
  SimulationSpec spec = with_fault(FaultKind::free_swinging, 3_joint, 0.5);
  spec.overspeed = {20.0, 20.0, 0.5};
  const SimulatedRun run = simulate(industrial(), spec);
  EXPECT_EQ(run.end, EndReason::overspeed_trip);
  EXPECT_LT(run.log.time.back(), 1.5);
  EXPECT_EQ(run.truth.at(0).end_s, run.log.time.back());
}

TEST(Simulate, HeldTorqueAndFastControlDifferAtTheSameSamplePeriod) {
  const Robot robot = preset_robot("RRP");
  SimulationSpec spec = short_run(4.0);
  spec.sample_period_s = spec.control_period_s = 0.073;
  const SimulatedRun held = simulate(robot, spec);
  // Held: integrating the logged torque over a sample from the logged state gives the next logged state.
  Plant plant(robot, {}, {}, 1e-3);
  for (int k = 0; k + 1 < held.log.rows(); ++k) {
    plant.q = row_of(held.log.q, k);
    plant.dq = row_of(held.log.dq, k);
    plant.advance(0.0, 0.073, row_of(held.log.tau, k));
    EXPECT_LT((plant.q - row_of(held.log.q, k + 1)).norm(), 1e-9);
  }
  spec.control_period_s = 0.001;
  const SimulatedRun fast = simulate(robot, spec);
  EXPECT_EQ(fast.log.rows(), held.log.rows());
  EXPECT_NE(fast.log.q, held.log.q);
}

double largest_difference(const JointSignals& a, const JointSignals& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < a[i].size(); ++k) most = std::max(most, std::abs(a[i][k] - b[i][k]));
  return most;
}

/// A light wrist with dry friction of this width, which is the stiffer the smaller it is.
Robot light_wrist(double width) {
  Robot robot = preset_robot("RRPR");
  robot = with_masses_and_lengths(robot, {3.0, 2.0, 0.7, 0.4}, {0.25, 0.2, 0.0, 0.0});
  robot.chain.links[3] = general_body(0.4, {0, 0, -0.05}, 2e-3 * Eigen::Matrix3d::Identity());
  robot.chain.friction = {
      {0.6, 0.8, 0, 0.03}, {0.4, 0.5, 0, 0.03}, {5.0, 2.0, 0, 0.01}, {0.02, 0.1, 0, width}};
  return robot;
}

TEST(Simulate, TheStepIsShortEnoughForStiffFriction) {
  for (const double width : {0.02, 0.008}) {  // at the second one the bodies are held over several steps
    SimulationSpec spec = short_run(2.0);
    const Log usual = simulate(light_wrist(width), spec).log;
    spec.max_step_s = 2e-5;
    const Log exact = simulate(light_wrist(width), spec).log;
    EXPECT_LT(largest_difference(usual.q, exact.q), 1e-5) << width;
    EXPECT_LT(largest_difference(usual.dq, exact.dq), 1e-3) << width;
  }
}

TEST(Simulate, FrictionSharperThanAnyStepStaysBounded) {
  Robot robot = industrial();
  for (auto& friction : robot.chain.friction) friction.width = 1e-7;
  const Log sharp = simulate(robot, short_run()).log;
  for (auto& friction : robot.chain.friction) friction.width = 2e-3;
  const Log soft = simulate(robot, short_run()).log;
  EXPECT_LT(largest_difference(sharp.q, soft.q), 1e-3);
}

TEST(Simulate, PdControlWithGravityHoldsTheJointAgainstItsWeight) {
  SimulationSpec spec = short_run();
  spec.controller.kind = ControllerKind::pd_gravity;
  spec.controller.bandwidth_rad_s = 8.0;
  spec.motion.points = {{0.5, -0.5, -0.1}};
  const SimulatedRun run = simulate(preset_robot("RRP"), spec);
  EXPECT_NEAR(run.log.q[2].back(), -0.1, 1e-6);
  EXPECT_NEAR(run.log.tau[2].back(), 9.81, 1e-6);
}

TEST(Simulate, WorksOnOtherChains) {
  for (const char* axes : {"RRPR", "RPRR", "RR", "R", "P"}) {
    Robot robot = preset_robot(axes);
    for (auto& friction : robot.chain.friction) friction = {0.1, 0.05, 0.0, 0.02};
    if (std::string(axes) == "RR") robot.chain.gravity = {0.0, -9.81, 0.0};
    const SimulatedRun run = simulate(robot, short_run(2.0));
    EXPECT_EQ(run.end, EndReason::complete) << axes;
    EXPECT_LT((row_of(run.log.q, 2000) - row_of(run.log.q_ref, 2000)).norm(), 1e-2) << axes;
  }
}

void expect_refused(const SimulationSpec& spec, const char* key) {
  try {
    simulate(industrial(), spec);
    FAIL() << key;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
  }
}

TEST(Simulate, RefusesInvalidSpecs) {
  SimulationSpec spec = short_run();
  spec.control_period_s = 0.0007;
  expect_refused(spec, "control_period_s");
  spec = short_run();
  spec.duration_s = -1.0;
  expect_refused(spec, "duration_s");
  spec = short_run();
  spec.noise.q = {1.0};
  expect_refused(spec, "noise.q");
  spec = short_run();
  spec.torque_limit = {1.0, 1.0};
  expect_refused(spec, "limits.torque");
  expect_refused(with_fault(FaultKind::locked, 4_joint, 1.0), "fault.joint");
  expect_refused(with_fault(FaultKind::torque_loss, 1_joint, 1.0, 1.5), "fault.size");
  expect_refused(with_fault(FaultKind::collision, 1_joint, 1.0, 5.0), "fault.end_s");
  expect_refused(with_fault(FaultKind::payload_change, 3_joint, 1.0, -9.0), "fault.size");
}

}  // namespace
}  // namespace faultline
