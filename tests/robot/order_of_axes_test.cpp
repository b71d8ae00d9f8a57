// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/error.hpp"
#include "lib/robot/fast_dynamics.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/robot/assorted_chains.hpp"
#include "tests/support/chain_mechanics.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

using Vector = JointVector;

TEST(OrderOfAxes, EightParallelAxesReachLikeAPlanarArm) {
  const Robot robot = preset_robot("RRRRRRRR");
  Random random(40);
  const Vector q = draw(random, 8, 3.0);
  double angle = 0.0, x = 0.0, y = 0.0;
  for (int i = 0; i < 8; ++i) {
    angle += q[i];
    x += std::cos(angle);
    y += std::sin(angle);
  }
  EXPECT_NEAR((tip_position(robot.chain, q) - Eigen::Vector3d(x, y, 0.0)).norm(), 0.0, 1e-13);
}

TEST(OrderOfAxes, SlidingAxesLiftAlongZAndCarryTheNextJointOnTheirLine) {
  const Robot robot = preset_robot("PRPRR");
  Vector q(5);
  q << 0.1, 0.3, 0.2, 0.4, 0.5;
  const Eigen::Vector3d expected(std::cos(0.3) + std::cos(0.7) + std::cos(1.2),
                                 std::sin(0.3) + std::sin(0.7) + std::sin(1.2), 0.3);
  EXPECT_NEAR((tip_position(robot.chain, q) - expected).norm(), 0.0, 1e-14);
}

TEST(OrderOfAxes, ALastRotationAfterASlideIsAWristOnlyAfterAnArm) {
  EXPECT_EQ(preset_robot("RRPR").shapes.back(), LinkShape::general);
  EXPECT_EQ(preset_robot("PRRPR").shapes.back(), LinkShape::general);
  EXPECT_EQ(preset_robot("PR").shapes.back(), LinkShape::rod);
  EXPECT_EQ(preset_robot("RPR").shapes.back(), LinkShape::rod);
}

TEST(OrderOfAxes, EveryOrderIsPlanarForTheFastDynamics) {
  for (const char* axes : {"RRRR", "PP", "PRRR", "RPRPRPRP", "PRRPR"}) {
    const FastDynamics fast(preset_robot(axes).chain);
    EXPECT_TRUE(fast.planar()) << axes;
  }
}

TEST(OrderOfAxes, EveryOrderRoundTripsThroughItsFile) {
  for (const char* axes : {"RRRR", "PP", "PRRPR", "RPRPRPRP"}) {
    const Robot robot = preset_robot(axes);
    const Robot again = robot_from_toml(robot_file_text(robot), axes);
    EXPECT_EQ(again.axes, axes);
    EXPECT_EQ(again.shapes, robot.shapes);
    EXPECT_EQ(robot_file_text(again), robot_file_text(robot));
  }
}

TEST(OrderOfAxes, AnInvalidOrderIsRefused) {
  for (const char* axes : {"", "RRRRRRRRR", "rrp", "RR P", "RRQ"})
    EXPECT_THROW(preset_robot(axes), Error) << axes;
}

TEST(OrderOfAxes, ReplacesAMissingRobotFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_robot_file("RRRR", folder.path().string()).axes, "RRRR");
  folder.write("RRRR", "axes = \"RP\"\n");
  EXPECT_EQ(load_robot_file("RRRR", folder.path().string()).axes, "RP");
}

TEST(OrderOfAxes, AMissingRobotFileIsRefusedWithAnExampleOfAxes) {
  const TemporaryFolder folder;
  try {
    load_robot_file("RRX", folder.path().string());
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::input);
    EXPECT_NE(error.message().find("such as RRP"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace faultline
