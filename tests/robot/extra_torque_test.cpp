// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include "lib/core/error.hpp"
#include "lib/core/random.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/fast_dynamics.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/robot/extra_torque_robot.hpp"
#include "tests/support/chain_mechanics.hpp"

namespace faultline {
namespace {

using testing::kExtraTorqueRobot;
using Vector = JointVector;

Vector draw(Random& random, double scale) {
  return Vector::NullaryExpr(3, [&] { return random.uniform(-scale, scale); });
}

TEST(ExtraTorque, InverseAndForwardDynamicsUndoEachOther) {
  const Chain chain = robot_from_toml(kExtraTorqueRobot, "robot").chain;
  const FastDynamics fast(chain);
  Random random(3);
  for (int k = 0; k < 50; ++k) {
    const Vector q = draw(random, 2.0), dq = draw(random, 2.0), ddq = draw(random, 5.0);
    const Vector tau = inverse_dynamics(chain, q, dq, ddq);
    Vector quick;
    fast.acceleration(q, dq, tau, quick);
    EXPECT_LT((forward_dynamics(chain, q, dq, tau) - ddq).norm(), 1e-9);
    EXPECT_LT((quick - ddq).norm(), 1e-9);
  }
}

TEST(ExtraTorque, EachPartFollowsItsEquation) {
  Chain chain = robot_from_toml(kExtraTorqueRobot, "robot").chain;
  const Vector q = Vector::Constant(3, 0.1);
  Vector dq(3), torque = Vector::Zero(3);
  dq << 0.5, -0.2, 0.3;
  add_extra_torque(chain, q, dq, torque);
  const double drag = 0.4 * 0.3 + 1.5 * std::tanh(0.3 / 0.02);
  EXPECT_NEAR(torque[0], drag, 1e-14);
  EXPECT_NEAR(torque[1], drag + 0.3 * std::cos(4.0) - 0.2 * std::sin(4.0), 1e-14);
  EXPECT_EQ(torque[2], 0.0);
  EXPECT_NEAR(load_friction(chain.friction[2], 1.0, -8.0), 0.2 * 8.0, 1e-12);
  EXPECT_NEAR(load_friction(chain.friction[2], -1.0, -8.0), -0.2 * 8.0, 1e-12);
  EXPECT_NEAR(carried_torque(chain.friction[2], -1.0, -8.0 * 1.2), -8.0, 1e-12);
  EXPECT_NEAR(carried_torque(chain.friction[2], 1.0, -8.0 * 0.8), -8.0, 1e-12);
}

TEST(ExtraTorque, TheRobotFileHoldsItAndIsReadBack) {
  const Robot robot = robot_from_toml(kExtraTorqueRobot, "robot");
  const std::string text = robot_file_text(robot);
  EXPECT_EQ(robot_file_text(robot_from_toml(text, "again")), text);
  Robot identified = robot;
  identified.identified = true;
  identified.torque_gain = {1.0, 1.1, 1.0};
  identified.gear_compliance = {0.0, 1e-4, 0.0};
  const std::string again = robot_file_text(identified);
  EXPECT_EQ(robot_file_text(robot_from_toml(again, "again")), again);
  EXPECT_NE(again.find("[[identified.ripple]]"), std::string::npos);
}

TEST(ExtraTorque, ImpossibleValuesAreRefusedWithTheReason) {
  const auto message = [](const char* text) {
    try {
      robot_from_toml(text, "robot");
    } catch (const Error& error) {
      return error.message();
    }
    return std::string("nothing");
  };
  EXPECT_NE(message("axes = \"RR\"\n[[ripple]]\njoint = 3\nrate = 2\n").find("from 1 to 2, found 3"),
            std::string::npos);
  EXPECT_NE(message("axes = \"RR\"\n[[ripple]]\njoint = 1\n").find("rate"), std::string::npos);
  EXPECT_NE(message("axes = \"RR\"\n[[shared_drive]]\nalong = [1, 0]\n").find("two joints or more"),
            std::string::npos);
  EXPECT_NE(message("axes = \"RR\"\n[known]\nfl1 = 2\n").find("below 0.9"), std::string::npos);
  EXPECT_NE(message("axes = \"RR\"\n[[joint]]\nfriction = {load = 1.5}\n[[joint]]\n").find("below 0.9"),
            std::string::npos);
}

}  // namespace
}  // namespace faultline
