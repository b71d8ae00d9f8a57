// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/sized_dynamics.hpp"

#include <gtest/gtest.h>

#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/robot/extra_torque_robot.hpp"

namespace faultline {
namespace {

using testing::kExtraTorqueRobot;

TEST(SizedDynamics, AHealthyRobotMovesAsItsChainDoes) {
  MotionModel model;
  model.chain = robot_from_toml(kExtraTorqueRobot, "robot").chain;
  const RobotLoad load(model);
  const SizedDynamics healthy(load, {});
  Random random(7);
  for (int k = 0; k < 50; ++k) {
    MotionState at;
    JointArray torque{};
    JointVector<double> q(3), dq(3), tau(3);
    for (int j = 0; j < 3; ++j) {
      at.q[j] = q[j] = random.uniform(-2.0, 2.0);
      at.dq[j] = dq[j] = random.uniform(-1.0, 1.0);
      torque[j] = tau[j] = random.uniform(-20.0, 20.0);
    }
    const JointVector<double> truth = forward_dynamics(model.chain, q, dq, tau);
    const Acceleration out = healthy.evaluate(at, torque, false);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(out.value[j], truth[j], 1e-9 * (1.0 + std::abs(truth[j]))) << j;
  }
}

}  // namespace
}  // namespace faultline
