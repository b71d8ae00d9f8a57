// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/transition.hpp"

#include <gtest/gtest.h>

#include "lib/fault/label_text.hpp"
#include "tests/reproduce/filter/prediction_world.hpp"

namespace faultline {
namespace {

using mechanical::moving_hypotheses;
using mechanical::PredictionWorld;

constexpr double kDelta = 1e-5;

/// A slow state of each kind, and where it stands.
std::vector<SlowState> one_of_each() {
  return {{SlowKind::friction, 0, 0.1, 0.0, 0.0},
          {SlowKind::torque_gain, 1, 0.1, 0.0, 0.0},
          {SlowKind::torque_offset, 0, 0.1, 0.0, 0.0},
          {SlowKind::coloured_torque, 1, 0.1, 0.0, 0.05},
          {SlowKind::tip_mass, 2, 0.1, 0.0, 0.0}};
}

struct World : PredictionWorld {
  World() { model.slow = one_of_each(); }

  /// q, dq, slow states and sizes, none of them 0.
  StateVector before(const Hypothesis& hypothesis) const {
    StateVector x{};
    for (int j = 0; j < 3; ++j) {
      x[j] = start.q[j];
      x[3 + j] = j == (hypothesis.label.kind == FaultKind::locked ? hypothesis.joint_index() : -1)
                     ? 0.0
                     : start.dq[j];
    }
    for (int s = 6; s < 11; ++s) x[s] = 0.1;
    for (int s = 11; s < 11 + hypothesis.sizes; ++s) x[s] = 0.3;
    return x;
  }

  StateVector after(StateVector x, const Hypothesis& hypothesis, double dt) const {
    MotionState motion = motion_of(x, 3);
    JointArray drive{};
    std::copy(torque.begin(), torque.end(), drive.begin());
    dynamics.integrate(motion, drive, dt, circumstances(x, model, &hypothesis));
    set_motion(x, motion, 3);
    return x;
  }
};

TEST(StepwiseTransition, IsTheDerivativeOfTheMotionByStateSlowStatesAndSizes) {
  const World world;
  JointArray drive{};
  std::copy(world.torque.begin(), world.torque.end(), drive.begin());
  for (const double dt : {0.02, 0.073}) {
    for (const Hypothesis& hypothesis : moving_hypotheses()) {
      const int size = 11 + hypothesis.sizes;
      const StateVector x = world.before(hypothesis);
      const MotionRows a =
          stepwise_transition(x, size, world.model, world.dynamics, drive, {}, dt, &hypothesis);
      for (int column = 0; column < size; ++column) {
        if (hypothesis.label.kind == FaultKind::locked && column == 3 + hypothesis.joint_index()) continue;
        StateVector above = x, below = x;
        above[column] += kDelta;
        below[column] -= kDelta;
        above = world.after(above, hypothesis, dt);
        below = world.after(below, hypothesis, dt);
        for (int row = 0; row < 6; ++row) {
          const double expected = (above[row] - below[row]) / (2.0 * kDelta);
          EXPECT_NEAR(a[row * size + column], expected, 0.02 * std::abs(expected) + 0.01)
              << label_text(hypothesis.label) << ", dt " << dt << ", row " << row << ", column " << column;
        }
      }
    }
  }
}

TEST(StepwiseTransition, StiffFrictionLeavesItStable) {
  World world;
  for (Friction<double>& friction : world.model.chain.friction) friction.width = 1e-4;
  const FaultDynamics dynamics(world.model);
  StateVector x{};
  x[0] = 0.3;
  x[1] = 0.8;
  const Hypothesis none{{FaultKind::unknown, 1}, 0.0, HypothesisForm::usual, 0};
  const MotionRows a = stepwise_transition(x, 11, world.model, dynamics, JointArray{}, {}, 0.073, &none);
  for (int row = 3; row < 6; ++row)
    for (int column = 3; column < 6; ++column) EXPECT_LT(std::abs(a[row * 11 + column]), 1.1);
}

}  // namespace
}  // namespace faultline
