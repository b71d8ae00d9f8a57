// SPDX-License-Identifier: MIT
#include "lib/residual/learn_residual.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/log/log_source.hpp"
#include "lib/residual/physics_step.hpp"
#include "lib/residual/residuals.hpp"
#include "tests/support/bench_motion.hpp"
#include "tests/support/chain_mechanics.hpp"

namespace faultline {
namespace {

LearnedResidual learn_on(const Log& log, const Robot& robot, const ResidualOptions& options) {
  MemorySource source(log);
  LogSource* logs[] = {&source};
  return learn_residual_generator(logs, robot, 0.0, options);
}

TEST(LearnResidual, ThePapersNetworkPredictsTheBenchRobot) {  // a study: 3.9e-5 by LM with 2500 patterns
  const Log log = bench_log(bench_robot(), {.duration_s = 130.0});
  const LearnedResidual learned = learn_on(
      log, bench_robot(),
      {.target = PredictedQuantity::state, .max_patterns = 1000, .twin_share = 0.0, .max_iterations = 25});
  EXPECT_EQ(learned.generator.mlp.inputs(), 9);
  EXPECT_EQ(learned.generator.mlp.outputs(), 6);
  EXPECT_EQ(learned.generator.shape.step, 1);
  EXPECT_LT(learned.normalised_mse, 5e-4);
  EXPECT_GT(learned.persistence_mse, 1e-3);
}

TEST(LearnResidual, PhysicsIsExactAndAHybridCorrectsAWrongRobot) {
  const Log log = bench_log(bench_robot(), {.duration_s = 130.0});
  EXPECT_LT(learn_on(log, bench_robot(), {.kind = ResidualKind::physics}).normalised_mse, 1e-18);
  Robot wrong = bench_robot();
  wrong = with_masses_and_lengths(wrong, {1.1, 0.84, 0.53}, {1.0, 0.8, 0.0});
  const double physics = learn_on(log, wrong, {.kind = ResidualKind::physics}).normalised_mse;
  const LearnedResidual hybrid = learn_on(
      log, wrong, {.kind = ResidualKind::hybrid, .hidden = {20}, .max_patterns = 1000, .max_iterations = 25});
  EXPECT_LT(hybrid.normalised_mse, 0.05 * physics);
}

TEST(LearnResidual, PatternsOfTheTwinReduceResidualsOfOtherMoves) {
  const BenchMotion few_moves{.duration_s = 30.0, .log_period_s = 0.01},
      others{.duration_s = 60.0, .log_period_s = 0.01, .seed = 8};
  const auto rms_on_others = [&](double twin_share) {
    const auto learned =
        learn_on(bench_log(bench_robot(), few_moves), bench_robot(),
                 {.hidden = {25}, .max_patterns = 800, .twin_share = twin_share, .max_iterations = 30});
    ResidualState state;
    const Residuals r = compute_residuals(learned.generator, bench_log(bench_robot(), others), state);
    return std::sqrt(r.torque.row(0).squaredNorm() / r.count());
  };
  EXPECT_LT(rms_on_others(1.0), 0.75 * rms_on_others(0.0));
}

TEST(LearnResidual, BackPropagationReducesTheError) {
  const Log log = bench_log(bench_robot(), {.duration_s = 130.0});
  const LearnedResidual learned = learn_on(log, bench_robot(),
                                           {.trainer = ResidualTrainer::back_propagation,
                                            .max_patterns = 1000,
                                            .twin_share = 0.0,
                                            .max_iterations = 300});
  EXPECT_LT(learned.normalised_mse, 0.5 * learned.persistence_mse);
}

TEST(LearnResidual, ChoosesAStepLongerThanARowAtHighRates) {
  const Log log = bench_log(bench_robot(), {.duration_s = 5.0, .log_period_s = 0.001});
  const LearnedResidual learned = learn_on(log, bench_robot(), {.kind = ResidualKind::physics});
  EXPECT_EQ(learned.generator.shape.step, 20);
  EXPECT_EQ(learned.generator.shape.stride, 6);
  EXPECT_NEAR(learned.generator.shape.step_s, 0.020, 1e-9);
}

TEST(LearnResidual, SegmentSizeAndRepetitionChangeNoBit) {
  const Log log = bench_log(bench_robot(), {.duration_s = 60.0});
  MemorySource small(log, "a", 13), large(log, "b", 4096);
  LogSource* first[] = {&small};
  LogSource* second[] = {&large};
  const ResidualOptions options{.hidden = {8}, .max_patterns = 200, .max_iterations = 5};
  const auto one = learn_residual_generator(first, bench_robot(), 0.0, options).generator;
  const auto two = learn_residual_generator(second, bench_robot(), 0.0, options).generator;
  EXPECT_TRUE(parameters_of(one.mlp) == parameters_of(two.mlp));
  EXPECT_TRUE(one.healthy.velocity_rms == two.healthy.velocity_rms);
}

TEST(LearnResidual, AJointThatTurnsWithoutEndIsPredictedModuloATurn) {
  Log log = bench_log(bench_robot(), {.duration_s = 130.0});
  for (int i = 0; i < log.rows(); ++i) log.q[0][i] = std::remainder(log.q[0][i] + 0.05 * i, 2 * M_PI);
  const LearnedResidual learned =
      learn_on(log, bench_robot(), {.hidden = {12}, .max_patterns = 800, .max_iterations = 15});
  EXPECT_TRUE(learned.generator.turns[0]);
  EXPECT_FALSE(learned.generator.turns[1]);
  EXPECT_EQ(learned.generator.mlp.inputs(), 10);
  EXPECT_LT(learned.generator.healthy.position_max[0], 0.5);  // no jump of a turn among the residuals
}

TEST(LearnResidual, TooShortOrForeignLogsAreRefused) {
  const Log log = bench_log(bench_robot(), {.duration_s = 2.0});
  EXPECT_THROW(learn_on(log, bench_robot(), {}), Error);
  EXPECT_THROW(learn_on(log, preset_robot("RR"), {}), Error);
}

TEST(PhysicsStep, ConservesEnergyAndStaysStableInStiffFriction) {
  const Robot robot = bench_robot();
  JointState x{JointVector::Constant(3, 0.4), JointVector::Constant(3, 1.2)};
  const double before = kinetic_energy(robot.chain, x.q, x.dq) + potential_energy(robot.chain, x.q);
  x = physics_step(FastDynamics(robot.chain), x, JointVector::Zero(3), 0.073);
  EXPECT_NEAR(kinetic_energy(robot.chain, x.q, x.dq) + potential_energy(robot.chain, x.q), before, 1e-8);

  Robot stiff = robot;
  for (auto& friction : stiff.chain.friction) friction = {.viscous = 1.0, .coulomb = 20.0, .width = 0.01};
  const JointState held =
      physics_step(FastDynamics(stiff.chain), {x.q, JointVector::Zero(3)}, JointVector::Zero(3), 0.073);
  EXPECT_LT(held.dq.cwiseAbs().maxCoeff(), 0.01);
}

}  // namespace
}  // namespace faultline
