// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/prediction.hpp"

#include <gtest/gtest.h>

#include "lib/fault/label_text.hpp"
#include "tests/reproduce/filter/prediction_world.hpp"

namespace faultline {
namespace {

using mechanical::covariance_of;
using mechanical::distance;
using mechanical::mean_of;
using mechanical::monte_carlo;
using mechanical::moving_hypotheses;
using mechanical::PredictionWorld;
using mechanical::robot_under;
using mechanical::state_of;
using Triple = FaultyScara::Triple;

constexpr int kDraws = 8000;

void expect_near_truth(const GaussianState& state, const FaultyScara::State& truth, double tolerance,
                       const std::string& what) {
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(state.mean[j], truth.q[j], tolerance) << what;
    EXPECT_NEAR(state.mean[3 + j], truth.dq[j], tolerance) << what;
  }
}

TEST(Predict, TheMeanFollowsTheClosedForm) {
  const PredictionWorld world;
  for (const double dt : {0.002, 0.01, 0.073})
    for (const Hypothesis& hypothesis : moving_hypotheses()) {
      const bool locks = hypothesis.label.kind == FaultKind::locked;
      GaussianState state =
          with_sizes(world.before(locks ? hypothesis.joint_index() : -1), hypothesis, world.model.priors);
      const Eigen::VectorXd x = mean_of(state);
      predict(state, world.model, world.dynamics, world.step(dt), &hypothesis, 0.0);
      expect_near_truth(state, robot_under(hypothesis, x).after(state_of(x), world.torque, dt),
                        dt < 0.05 ? 1e-3 : 0.02, label_text(hypothesis.label));
      for (int s = 6; s < state.size; ++s) EXPECT_EQ(state.mean[s], x[s]) << "a size stays what it is";
    }
}

TEST(Predict, TheTorqueLiesBetweenTheSamplesByPhi) {
  PredictionWorld world;
  world.model.torque_phi = 0.25;
  const Triple next = {-20.0, 6.0, 60.0};
  Triple between;
  for (int j = 0; j < 3; ++j) between[j] = 0.75 * world.torque[j] + 0.25 * next[j];
  GaussianState state = world.before();
  Step step = world.step(0.01);
  step.next_torque = next;
  predict(state, world.model, world.dynamics, step, nullptr, 0.0);
  expect_near_truth(state, world.truth.after(world.start, between, 0.01), 1e-5, "healthy");
}

TEST(Predict, TheCovarianceIsThatOfTheNonlinearRobot) {
  const PredictionWorld world;
  for (const double dt : {0.004, 0.01, 0.03})
    for (Hypothesis hypothesis : moving_hypotheses()) {
      hypothesis.duration_s = 1e9;  // the pulse's own noise has a test of its own
      if (hypothesis.label.kind == FaultKind::unknown) continue;
      const bool locks = hypothesis.label.kind == FaultKind::locked;
      const GaussianState before =
          with_sizes(world.before(locks ? hypothesis.joint_index() : -1), hypothesis, world.model.priors);
      GaussianState after = before;
      predict(after, world.model, world.dynamics, world.step(dt), &hypothesis, 0.0);
      const auto sampled = monte_carlo(before, kDraws, [&](const Eigen::VectorXd& x, Random&) {
        return robot_under(hypothesis, x).after(state_of(x), world.torque, dt, 4);
      });
      EXPECT_LT(distance(covariance_of(after), sampled.covariance), dt == 0.01 ? 0.12 : 0.06)
          << label_text(hypothesis.label) << " over " << dt;
    }
}

TEST(Predict, TheHealthyCovarianceIsThatOfTheNonlinearRobot) {
  const PredictionWorld world;
  for (const double dt : {0.004, 0.01, 0.073}) {
    GaussianState after = world.before();
    predict(after, world.model, world.dynamics, world.step(dt), nullptr, 0.0);
    const auto sampled = monte_carlo(world.before(), kDraws, [&](const Eigen::VectorXd& x, Random&) {
      return world.truth.after(state_of(x), world.torque, dt, 8);
    });
    EXPECT_LT(distance(covariance_of(after), sampled.covariance), 0.06) << dt;
  }
}

TEST(Predict, DoubtOfAVelocityIsDampedAndBecomesDoubtOfThePosition) {
  PredictionWorld world;
  world.q_std = 0.0;
  for (const double dt : {0.001, 0.004, 0.01, 0.02}) {
    GaussianState state = world.before();
    predict(state, world.model, world.dynamics, world.step(dt), nullptr, 0.0);
    const double damping = 20.0 / 2.5, kept = std::exp(-damping * dt), way = (1.0 - kept) / damping;
    EXPECT_NEAR(state.p(5, 5) / (world.dq_std * world.dq_std), kept * kept, 0.006) << dt;
    EXPECT_NEAR(state.p(2, 2) / (world.dq_std * world.dq_std * way * way), 1.0, 0.1) << dt;
    EXPECT_NEAR(state.p(2, 5) / (world.dq_std * world.dq_std * way * kept), 1.0, 0.06) << dt;
  }
}

/// Covariance of the vertical joint, which is a mass of its own, after a step from an exact state.
Eigen::Matrix2d noise_of_joint_3(const PredictionWorld& world, const Step& step) {
  GaussianState state = world.before();
  state.covariance.fill(0.0);
  predict(state, world.model, world.dynamics, step, nullptr, 0.0);
  Eigen::Matrix2d p;
  p << state.p(2, 2), state.p(2, 5), state.p(5, 2), state.p(5, 5);
  return p;
}

/// What an impulse of that variance, spread over the step, makes of a mass.
Eigen::Matrix2d of_impulse(double variance, double mass, double dt) {
  Eigen::Matrix2d p;
  p << dt * dt / 3.0, 0.5 * dt, 0.5 * dt, 1.0;
  return p * (variance / (mass * mass));
}

TEST(Predict, ProcessNoiseIsWhiteTorque) {
  PredictionWorld world;
  world.model.noise.floor = {0.0, 0.0, 0.7};
  world.model.noise.torque_share = 0.1;
  world.model.noise.rest_share = 0.5;
  const double moving = 0.02 * (0.7 * 0.7 + 1.2 * 1.2);
  EXPECT_TRUE(
      noise_of_joint_3(world, world.step(0.002)).isApprox(of_impulse(0.002 * moving, 2.5, 0.002), 1e-9));
  world.start.dq[2] = 0.005;
  EXPECT_TRUE(noise_of_joint_3(world, world.step(0.002))
                  .isApprox(of_impulse(0.002 * (moving + 0.02 * 16.0), 2.5, 0.002), 1e-9))
      << "near rest, half of 8 N of dry friction more";
}

TEST(Predict, WhatTheTorqueDidBetweenTheSamplesIsNoise) {
  PredictionWorld world;
  world.model.noise.step_share = 0.3;
  const Triple next = {6.5, -3.0, 22.0};
  Step step = world.step(0.01);
  step.next_torque = next;
  EXPECT_TRUE(noise_of_joint_3(world, step).isApprox(of_impulse(1e-4 * 9.0, 2.5, 0.01), 1e-9));
}

TEST(Predict, AMissingTorqueMayBeHalfTheLargest) {
  const PredictionWorld world;
  const bool missing[] = {false, false, true};
  Step step = world.step(0.01);
  step.torque_missing = missing;
  EXPECT_TRUE(noise_of_joint_3(world, step).isApprox(of_impulse(1e-4 * 400.0, 2.5, 0.01), 1e-9));
  step.torque_missing = {};
  step.next_torque_missing = missing;
  EXPECT_TRUE(noise_of_joint_3(world, step).isApprox(of_impulse(1e-4 * 400.0, 2.5, 0.01), 1e-9));
}

TEST(Predict, AnEndStopMayStopOrPushAPressedJoint) {
  const PredictionWorld world;
  const bool pressed[] = {false, false, true};
  Step step = world.step(0.01);
  step.pressed = pressed;
  GaussianState moved = world.before();
  predict(moved, world.model, world.dynamics, world.step(0.01), nullptr, 0.0);
  const double push = 40.0 * 0.01 / 2.5, speed = moved.mean[5];
  EXPECT_TRUE(
      noise_of_joint_3(world, step).isApprox(of_impulse(speed * speed + push * push, 1.0, 0.01), 1e-9));
}

TEST(Predict, ALockedJointsVelocityIsKnown) {
  const PredictionWorld world;
  const Hypothesis locked{{FaultKind::locked, 2}, 0.0, HypothesisForm::usual, 0};
  GaussianState state = world.before();
  predict(state, world.model, world.dynamics, world.step(0.01), &locked, 0.1);
  EXPECT_EQ(state.mean[4], 0.0);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(state.p(4, i) + state.p(i, 4), 0.0);
}

TEST(Predict, APushIsOverAfterItsDuration) {
  const PredictionWorld world;
  for (const int joint : {0, 2}) {
    const HypothesisForm form = joint ? HypothesisForm::usual : HypothesisForm::push_on_all_joints;
    const Hypothesis push{{FaultKind::collision, joint}, 0.04, form, joint ? 1 : 3};
    GaussianState state = with_sizes(world.before(), push, world.model.priors);
    for (int s = 6; s < state.size; ++s) state.mean[s] = 3.0;
    GaussianState during = state;
    predict(during, world.model, world.dynamics, world.step(0.01), &push, 0.039);
    EXPECT_EQ(during.mean[6], 3.0);
    const double scale = world.model.priors.external_torque[joint ? 1 : 0];
    EXPECT_NEAR(during.p(6, 6), scale * scale * (1.0 + 2.0 * 0.01 / 0.04), 1e-12) << "of any shape";
    predict(state, world.model, world.dynamics, world.step(0.01), &push, 0.041);
    for (int s = 6; s < state.size; ++s) {
      EXPECT_EQ(state.mean[s], 0.0);
      for (int i = 0; i < state.size; ++i) EXPECT_EQ(state.p(s, i) + state.p(i, s), 0.0);
    }
  }
}

TEST(Predict, AnUnknownTorqueWandersByItsScaleInATenthOfASecond) {
  const PredictionWorld world;
  const Hypothesis unknown{{FaultKind::unknown, 1}, 0.0, HypothesisForm::usual, 1};
  GaussianState state = with_sizes(world.before(), unknown, world.model.priors);
  predict(state, world.model, world.dynamics, world.step(0.01), &unknown, 0.0);
  EXPECT_NEAR(state.p(6, 6), 4.0 * (1.0 + 0.1), 1e-12);
}

}  // namespace
}  // namespace faultline
