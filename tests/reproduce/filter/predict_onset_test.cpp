// SPDX-License-Identifier: MIT
// predict_onset(): the step within which a fault begins.
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
using State = FaultyScara::State;

/// The sizes' own noise over the step is left out: it has tests of its own.
std::vector<Hypothesis> hypotheses_without_noise() {
  std::vector<Hypothesis> all = moving_hypotheses();
  std::erase_if(all, [](const Hypothesis& h) { return h.label.kind == FaultKind::unknown; });
  for (Hypothesis& h : all) h.duration_s = 1e9;
  return all;
}

GaussianState onset_of(const PredictionWorld& world, const Hypothesis& hypothesis,
                       const GaussianState& before, double dt) {
  GaussianState state = with_sizes(before, hypothesis, world.model.priors);
  predict_onset(state, world.model, world.dynamics, world.step(dt), hypothesis);
  return state;
}

Eigen::VectorXd vector_of(const State& x) {
  Eigen::VectorXd v(6);
  for (int j = 0; j < 3; ++j) v[j] = x.q[j], v[3 + j] = x.dq[j];
  return v;
}

/// Where the robot is after the step when the fault of state `x` was there for the last `share` of it.
State truth_after(const PredictionWorld& world, const Hypothesis& hypothesis, const Eigen::VectorXd& x,
                  double share, double dt) {
  State state = world.truth.after(state_of(x), world.torque, (1.0 - share) * dt, 8);
  if (hypothesis.label.kind == FaultKind::locked) state.dq[hypothesis.joint_index()] = 0.0;
  return robot_under(hypothesis, x).after(state, world.torque, share * dt, 8);
}

/// mean d/2 and covariance d d^T / 12 + B P B^T / 3, from an exact state and by differences of the truth.
struct Blend {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance, with_size;
};
Blend blend_of(const PredictionWorld& world, const Hypothesis& hypothesis, double dt) {
  const GaussianState before = with_sizes(world.before(), hypothesis, world.model.priors);
  const Eigen::VectorXd x = mean_of(before);
  const auto whole = [&](const Eigen::VectorXd& at) {
    return vector_of(truth_after(world, hypothesis, at, 1.0, dt));
  };
  const Eigen::VectorXd late = vector_of(truth_after(world, hypothesis, x, 0.0, dt)), d = whole(x) - late;
  Blend out{late + 0.5 * d, d * d.transpose() / 12.0, Eigen::MatrixXd(6, hypothesis.sizes)};
  for (int s = 0; s < hypothesis.sizes; ++s) {
    Eigen::VectorXd more = x, less = x;
    more[6 + s] += 1e-3;
    less[6 + s] -= 1e-3;
    const Eigen::VectorXd b = (whole(more) - whole(less)) / 2e-3;
    out.covariance += b * b.transpose() * before.p(6 + s, 6 + s) / 3.0;
    out.with_size.col(s) = 0.5 * b * before.p(6 + s, 6 + s);
  }
  return out;
}

TEST(PredictOnset, BlendsAFaultOfAllTheStepAndOneOfNone) {
  const PredictionWorld world;
  for (const double dt : {0.004, 0.01, 0.03})
    for (const Hypothesis& hypothesis : hypotheses_without_noise()) {
      GaussianState exact = world.before();
      exact.covariance.fill(0.0);
      const GaussianState state = onset_of(world, hypothesis, exact, dt);
      const Blend expected = blend_of(world, hypothesis, dt);
      const Eigen::MatrixXd p = covariance_of(state);
      const auto what = label_text(hypothesis.label) + " over " + std::to_string(dt);
      EXPECT_LT((mean_of(state).head(6) - expected.mean).cwiseAbs().maxCoeff(), 3e-4) << what;
      const bool coarse = dt == 0.01 && hypothesis.label.kind == FaultKind::payload_change;
      const double tolerance = coarse ? 0.45 : 0.15;  // the analytic transition takes the slope at the start
      const Eigen::VectorXd std = expected.covariance.diagonal().cwiseSqrt();
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j)
          EXPECT_NEAR(p(i, j), expected.covariance(i, j), tolerance * std[i] * std[j] + 1e-10) << what;
        for (int s = 0; s < hypothesis.sizes; ++s)
          EXPECT_NEAR(
              p(i, 6 + s), expected.with_size(i, s),
              0.2 * std::abs(expected.with_size(i, s)) + 0.01 * std[i] * std::sqrt(p(6 + s, 6 + s)) + 1e-12)
              << what;
      }
    }
}

TEST(PredictOnset, VelocitiesAreThoseOfAFaultAtAnyMomentOfTheStep) {
  PredictionWorld world;
  world.q_std = 1e-4;
  constexpr double kStep_s = 0.01;
  for (const Hypothesis& hypothesis : hypotheses_without_noise()) {
    const GaussianState before = with_sizes(world.before(), hypothesis, world.model.priors);
    const GaussianState after = onset_of(world, hypothesis, world.before(), kStep_s);
    const auto sampled = monte_carlo(before, 8000, [&](const Eigen::VectorXd& x, Random& random) {
      return truth_after(world, hypothesis, x, random.uniform(), kStep_s);
    });
    const int first =
        hypothesis.label.kind == FaultKind::locked ? 5 : 3;  // a locked joint's velocity is exact
    const Eigen::Index count = after.size - first;
    const Eigen::VectorXd off = mean_of(after) - sampled.mean;
    for (int i = first; i < after.size; ++i)
      EXPECT_LT(std::abs(off[i]), 0.06 * std::sqrt(sampled.covariance(i, i))) << label_text(hypothesis.label);
    EXPECT_LT(distance(covariance_of(after).bottomRightCorner(count, count),
                       sampled.covariance.bottomRightCorner(count, count)),
              0.06)
        << label_text(hypothesis.label);
  }
}

TEST(PredictOnset, ARigidLockJoltsTheOtherJoints) {
  const PredictionWorld world;
  const Hypothesis soft{{FaultKind::locked, 2}, 0.0, HypothesisForm::usual, 0},
      rigid{{FaultKind::locked, 2}, 0.0, HypothesisForm::rigid_lock, 0};
  const GaussianState a = onset_of(world, soft, world.before(), 0.002),
                      b = onset_of(world, rigid, world.before(), 0.002);
  const JointArray jolt = world.dynamics.stopping_impulse(mechanical::motion_of(world.start), 1);
  EXPECT_GT(std::abs(jolt[0]), 0.1);
  EXPECT_NEAR(b.mean[3] - a.mean[3], jolt[0], 0.05 * std::abs(jolt[0]));
  EXPECT_EQ(b.mean[4], 0.0);
  EXPECT_EQ(a.mean[4], 0.0);
  EXPECT_EQ(b.p(4, 4), 0.0);
}

TEST(PredictOnset, ALockStopsTheJointSomewhereInTheStep) {
  const PredictionWorld world;
  const Hypothesis soft{{FaultKind::locked, 1}, 0.0, HypothesisForm::usual, 0};
  const GaussianState a = onset_of(world, soft, world.before(), 0.01);
  EXPECT_NEAR(a.mean[0], world.start.q[0] + 0.5 * 0.01 * world.start.dq[0], 3e-4);
  const double way = 0.01 * world.start.dq[0];
  EXPECT_NEAR(a.p(0, 0), world.q_std * world.q_std + way * way / 12.0, 2e-6);
}

TEST(PredictOnset, AFaultySensorChangesNothingOfTheMotion) {
  const PredictionWorld world;
  for (const FaultKind kind :
       {FaultKind::sensor_bias, FaultKind::sensor_drift, FaultKind::stuck_encoder, FaultKind::none}) {
    const Hypothesis hypothesis{{kind, kind == FaultKind::none ? 0 : 2}, 0.0, HypothesisForm::usual, 0};
    GaussianState healthy = world.before();
    predict(healthy, world.model, world.dynamics, world.step(0.01), nullptr, 0.0);
    const GaussianState state = onset_of(world, hypothesis, world.before(), 0.01);
    EXPECT_EQ(mean_of(state), mean_of(healthy)) << to_string(kind);
    EXPECT_EQ(covariance_of(state), covariance_of(healthy)) << to_string(kind);
  }
}

}  // namespace
}  // namespace faultline
