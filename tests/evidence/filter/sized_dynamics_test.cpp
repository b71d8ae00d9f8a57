// SPDX-License-Identifier: MIT
#include "lib/evidence/filter/sized_dynamics.hpp"

#include <gtest/gtest.h>

#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {
namespace {

const char* const kRobot = R"(
axes = "RRP"
[friction]
viscous = [0.5, 0.3, 2.0]
coulomb = [0.6, 0.4, 1.0]
offset = [0.1, -0.2, 0.0]
bend = [-0.2, 0.0, 0.0]
skew = [0.0, 0.05, 0.0]
load = [0.1, 0.0, 0.2]
[[ripple]]
joint = 2
rate = 40
cosine = 0.3
sine = -0.2
[[shared_drive]]
along = [1, 1, 0]
viscous = 0.4
coulomb = 1.5
width = 0.02
rotor_inertia = 0.05
)";

TEST(SizedDynamics, AHealthyRobotMovesAsItsChainDoes) {
  MotionModel model;
  model.chain = robot_from_toml(kRobot, "robot").chain;
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
