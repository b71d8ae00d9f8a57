// SPDX-License-Identifier: MIT
#include "lib/reproduce/protocol/motion_generator.hpp"

#include <gtest/gtest.h>

namespace faultline {
namespace {

TEST(MotionGenerator, RunsHoldAsManyPatternsAsTrajectories) {
  const Experiment experiment = experiment_on(bench_robot(), ControllerVariant::held, 1);
  const auto use = SeedUse::generator_test;
  const auto single = healthy_trajectories(experiment, 20, 0.0, use);
  const auto runs = healthy_runs(experiment, 20, 0.0, use);
  EXPECT_EQ(single.size(), 20u);
  EXPECT_EQ(runs.size(), 2u);
  EXPECT_EQ(transitions_of(runs).count(), transitions_of(single).count());
}

TEST(MotionGenerator, NoTestTrajectoryIsUsedForTraining) {
  const Experiment experiment = experiment_on(bench_robot(), ControllerVariant::held, 1);
  const auto training = healthy_trajectories(experiment, 120, 0.0, SeedUse::generator_training);
  const auto test = healthy_trajectories(experiment, 200, 0.0, SeedUse::generator_test);
  for (const Log& mine : test)
    for (const Log& theirs : training) ASSERT_NE(mine.q[0], theirs.q[0]);
}

TEST(MotionGenerator, TheErrorIsInHalfRangesOfEachOutput) {
  const HalfRanges ranges{Eigen::Vector3d(2.0, 4.0, 0.5), Eigen::Vector3d(1.0, 10.0, 5.0), {}};
  Eigen::MatrixXd error(6, 2);
  error << 2.0, -2.0, 4.0, 0.0, 0.5, 0.5, 0.0, 0.0, 10.0, -10.0, 0.5, 0.5;
  const Eigen::VectorXd mse = normalised_mse_by_output(error, ranges);
  const double expected[] = {1.0, 0.5, 1.0, 0.0, 1.0, 0.01};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(mse[i], expected[i], 1e-15) << i;
}

TEST(MotionGenerator, PhysicsOfTheTrueRobotIsExactForHeldTorque) {
  const Experiment experiment = experiment_on(bench_robot(), ControllerVariant::held, 1);
  GeneratorRecipe recipe;
  recipe.fit.kind = ResidualKind::physics;
  const ResidualGenerator physics = untrained_generator(experiment.robot, recipe);
  const Transitions test = transitions_of(healthy_runs(experiment, 20, 0.0, SeedUse::generator_test));
  const Eigen::MatrixXd error = measured_change(physics, test) - predicted_change(physics, test);
  EXPECT_LT(normalised_mse_by_output(error, experiment.ranges).mean(), 1e-12);
}

}  // namespace
}  // namespace faultline
