// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/core/error.hpp"
#include "lib/robot/dynamics.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/robot/urdf/urdf.hpp"
#include "tests/robot/assorted_chains.hpp"
#include "tests/support/chain_mechanics.hpp"

namespace faultline {
namespace {

using Vector = JointVector;

Robot with_friction(Robot robot, Random& random) {
  for (auto& friction : robot.chain.friction)
    friction = {random.uniform(0.1, 2.0), random.uniform(0.1, 2.0), random.normal(),
                random.uniform(1e-3, 0.1)};
  return robot;
}

Robot six_axes(Random& random) {
  Robot robot = preset_robot("RRRPRR");
  robot.name = "six <\"&'> axes";
  robot.axes = "";
  robot.shapes.assign(6, LinkShape::general);
  robot.chain = with_general_bodies(robot.chain, random);
  for (JointGeometry& joint : robot.chain.geometry) {
    joint.axis = draw3(random).normalized();
    joint.offset = 0.3 * draw3(random);
    joint.direction = draw3(random).normalized();
  }
  robot.chain.geometry[0].direction.setZero();
  robot.chain.gravity = 9.81 * draw3(random).normalized();
  return with_friction(robot, random);
}

Robot again(const Robot& robot) { return robot_from_urdf(urdf_text(robot), "again.urdf"); }

void expect_moves_alike(const Robot& a, const Robot& b) {
  ASSERT_EQ(a.joints(), b.joints());
  Random random(71);
  for (int k = 0; k < 50; ++k) {
    const Vector q = draw(random, a.joints(), 3.0), dq = draw(random, a.joints(), 3.0);
    const Vector ddq = draw(random, a.joints(), 5.0);
    const Vector tau = inverse_dynamics(a.chain, q, dq, ddq);
    EXPECT_LT((inverse_dynamics(b.chain, q, dq, ddq) - tau).norm(), 1e-12 * tau.norm());
    EXPECT_LT((tip_position(a.chain, q) - tip_position(b.chain, q)).norm(), 1e-12);
  }
}

TEST(UrdfExport, IsReadBackAsARobotThatMovesIdentically) {
  Random random(70);
  for (const char* axes : {"RRP", "RR", "RRPR", "P", "PRRR"}) {
    Robot robot = with_friction(preset_robot(axes), random);
    expect_moves_alike(robot, again(robot));
    EXPECT_EQ(again(robot).axes, axes);
    EXPECT_EQ(again(robot).shapes, robot.shapes);
    EXPECT_EQ(again(robot).chain.length, robot.chain.length);
  }
  for (int k = 0; k < 5; ++k) {
    const Robot robot = six_axes(random);
    expect_moves_alike(robot, again(robot));
    EXPECT_EQ(again(robot).name, robot.name);
  }
}

TEST(UrdfExport, KeepsThePropertiesThatUrdfCannotHold) {
  Robot robot = robot_from_toml(R"(
name = "cell \u0001 4"
axes = "RRP"
gravity = [0.1, 0, -9.8]
rotor_inertia = [0.1, 0.2, 0]
[known]
l1 = 0.35
m3 = {value = 2.5, std = 0.01}
[payload]
"run <7>.csv" = 1.5
[friction]
offset = [0.1, -0.2, 0]
width = 0.02
[least_size]
torque_loss = 0.08
[log]
torque = "measured"
coupling = [[1, 0, 0], [-1, 1, 0], [0, 0, 1]]
[log.columns]
q1 = {name = "J1 ]]> & \"position\"", unit = "deg"}
)",
                                "r.toml");
  EXPECT_EQ(robot_file_text(again(robot)), robot_file_text(robot));
  robot.identified = true;
  robot.torque_phi = 1.0 / 3.0;
  EXPECT_TRUE(again(robot).identified);
  EXPECT_EQ(again(robot).torque_phi, robot.torque_phi);
}

TEST(UrdfExport, KeepsInfeasibleIdentifiedNumbers) {
  Random random(72);
  Robot robot = with_friction(preset_robot("RRP"), random);
  robot.identified = true;
  robot.known["m1"] = {1.0, 0.0};
  robot.chain.links[0].mass = 0.0;
  robot.chain.links[0].first_moment = {0.3, 0.1, 0.0};
  robot.chain.links[1].mass = -0.2;
  robot.chain.links[2].mass = 1e-17;
  robot.chain.links[2].first_moment = {0.3, -0.1, 0.2};
  robot.chain.friction[1].viscous = -1e-3;
  robot.chain.rotor_inertia[1] = -1e-3;
  const Robot back = again(robot);
  expect_moves_alike(robot, back);
  EXPECT_EQ(back.chain.links[0].mass, 0.0);
  EXPECT_EQ(back.chain.links[0].first_moment, robot.chain.links[0].first_moment);
}

TEST(UrdfExport, WithoutItsOwnElementTheBodiesMoveIdentically) {
  Random random(73);
  Robot robot = six_axes(random);
  robot.chain.gravity = {0, 0, -9.81};
  for (auto& friction : robot.chain.friction) friction.offset = 0.0, friction.width = 0.01;
  robot.chain.rotor_inertia.assign(6, 0.0);
  std::string text = urdf_text(robot);
  const auto begin = text.find("<faultline>"), end = text.find("</faultline>");
  text.erase(begin, end + 12 - begin);
  expect_moves_alike(robot, robot_from_urdf(text, "other.urdf"));
}

TEST(UrdfExport, EditsOfTheBodiesAreUsed) {
  std::string text = urdf_text(preset_robot("RRPR"));
  const std::string mass = "<mass value=\"1\"/>";
  text.replace(text.rfind(mass), mass.size(), "<mass value=\"4\"/>");
  EXPECT_EQ(robot_from_urdf(text, "edited.urdf").chain.links[3].mass, 4.0);
}

TEST(UrdfExport, AnElementOfAnotherRobotIsRefused) {
  const std::string two = urdf_text(preset_robot("RR")), three = urdf_text(preset_robot("RRR"));
  const std::string text = two.substr(0, two.find("<faultline>")) + three.substr(three.find("<faultline>"));
  try {
    robot_from_urdf(text, "r.urdf");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(error.where().find("r.urdf, <faultline>"), std::string::npos) << error.what();
  }
}

TEST(UrdfExport, TheNameOfTheFileChoosesTheFormat) {
  const Robot robot = preset_robot("RR");
  EXPECT_EQ(robot_text_for("out/R.URDF", robot), urdf_text(robot));
  EXPECT_EQ(robot_text_for("out/urdf.toml", robot), robot_file_text(robot));
  EXPECT_EQ(robot_text_for("-", robot), robot_file_text(robot));
}

}  // namespace
}  // namespace faultline
