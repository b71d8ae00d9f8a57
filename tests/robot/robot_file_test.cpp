// SPDX-License-Identifier: MIT
#include "lib/robot/robot_file.hpp"

#include <gtest/gtest.h>

namespace faultline {
namespace {

void expect_same_chain(const Chain& a, const Chain& b) {
  ASSERT_EQ(a.joints(), b.joints());
  EXPECT_EQ(a.gravity, b.gravity);
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.rotor_inertia, b.rotor_inertia);
  for (int i = 0; i < a.joints(); ++i) {
    EXPECT_EQ(a.geometry[i].kind, b.geometry[i].kind);
    EXPECT_EQ(a.geometry[i].axis, b.geometry[i].axis);
    EXPECT_EQ(a.geometry[i].offset, b.geometry[i].offset);
    EXPECT_EQ(a.geometry[i].direction, b.geometry[i].direction);
    EXPECT_EQ(a.links[i].mass, b.links[i].mass);
    EXPECT_EQ(a.links[i].first_moment, b.links[i].first_moment);
    EXPECT_EQ(a.links[i].inertia, b.links[i].inertia);
    EXPECT_EQ(a.friction[i].viscous, b.friction[i].viscous);
    EXPECT_EQ(a.friction[i].coulomb, b.friction[i].coulomb);
    EXPECT_EQ(a.friction[i].offset, b.friction[i].offset);
    EXPECT_EQ(a.friction[i].width, b.friction[i].width);
  }
}

const char* const kFull = R"(
name = "bench \"B\""
axes = "RRP"
gravity = [0.1, 0, -9.8]
width = 0.02
rotor_inertia = [0.1, 0.2, 0]

[known]
l1 = 0.35
m3 = {value = 2.5, std = 0.01}

[payload]
"run 7.csv" = 1.5

[friction]
viscous = [2, 1, 20]
coulomb = 3.3

[log]
torque = "measured"
torque_between_samples = "held"
[log.columns]
t = {name = "stamp", unit = "ms"}
q1 = "J1 position"
tau2 = {name = "i2", unit = "A", sign = -1, scale = 35.15065, offset = 0.5}
)";

TEST(RobotFile, AxesAloneAreEnough) {
  const Robot robot = robot_from_toml("axes = \"RRP\"", "r.toml");
  EXPECT_EQ(robot.joints(), 3);
  EXPECT_EQ(robot.name, "RRP");
  EXPECT_EQ(robot.chain.gravity, Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(robot.log.torque, TorqueMeaning::commanded);
  EXPECT_EQ(robot.log.torque_between_samples, TorqueTiming::unknown);
  EXPECT_TRUE(robot.known.empty());
  EXPECT_FALSE(robot.identified);
}

TEST(TorqueBetweenSamples, IsAsStatedOrElseNearestToTheIdentifiedTiming) {
  Robot robot = robot_from_toml("axes = \"RRP\"", "r.toml");
  EXPECT_EQ(torque_between_samples(robot), TorqueTiming::unknown);
  robot.torque_phi = 0.02;
  EXPECT_EQ(torque_between_samples(robot), TorqueTiming::held);
  robot.torque_phi = 0.5;
  EXPECT_EQ(torque_between_samples(robot), TorqueTiming::linear);
  robot.log.torque_between_samples = TorqueTiming::held;
  EXPECT_EQ(torque_between_samples(robot), TorqueTiming::held);
}

TEST(RobotFile, NormalRangesHaveDefaultsAndAreKept) {
  EXPECT_EQ(robot_from_toml("axes = \"RRP\"", "r.toml").normal, NormalRange{});
  const Robot robot = robot_from_toml(
      "axes = \"RRP\"\n[normal]\nfriction = 0.5\ntorque_offset = 0\nnoise = [0.8, 3]\n"
      "work_piece_kg = 1.2",
      "r.toml");
  EXPECT_EQ(robot.normal.friction, 0.5);
  EXPECT_EQ(robot.normal.torque_offset, 0.0);
  EXPECT_EQ(robot.normal.noise, (std::array<double, 2>{0.8, 3.0}));
  EXPECT_EQ(robot.normal.work_piece_kg, 1.2);
  EXPECT_EQ(robot.normal.torque_constant, NormalRange{}.torque_constant);
  EXPECT_EQ(robot_from_toml(robot_file_text(robot), "again").normal, robot.normal);
}

TEST(RobotFile, ReadsEveryKeyOfTheContract) {
  const Robot robot = robot_from_toml(kFull, "r.toml");
  EXPECT_EQ(robot.name, "bench \"B\"");
  EXPECT_EQ(robot.known.at("l1").value, 0.35);
  EXPECT_EQ(robot.known.at("l1").std, 0.0);
  EXPECT_EQ(robot.known.at("m3").std, 0.01);
  EXPECT_EQ(robot.payloads.at("run 7.csv").value, 1.5);
  EXPECT_EQ(robot.chain.length[0], 0.35);
  EXPECT_NEAR(robot.chain.links[0].inertia(2, 2), 0.35 * 0.35 / 3, 1e-15);
  EXPECT_EQ(robot.chain.links[2].mass, 2.5);
  EXPECT_EQ(robot.chain.friction[2].viscous, 20.0);
  EXPECT_EQ(robot.chain.friction[1].coulomb, 3.3);
  EXPECT_EQ(robot.chain.friction[1].width, 0.02);
  EXPECT_EQ(robot.chain.rotor_inertia[1], 0.2);
  EXPECT_EQ(robot.log.torque, TorqueMeaning::measured);
  EXPECT_EQ(robot.log.torque_between_samples, TorqueTiming::held);
  EXPECT_EQ(robot.log.columns.at("q1").name, "J1 position");
  EXPECT_EQ(robot.log.columns.at("tau2").scale, 35.15065);
  EXPECT_EQ(robot.log.columns.at("tau2").sign, -1.0);
}

TEST(RobotFile, TextRoundTripsExactly) {
  const Robot robot = robot_from_toml(kFull, "r.toml");
  const std::string text = robot_file_text(robot);
  const Robot again = robot_from_toml(text, "again");
  expect_same_chain(robot.chain, again.chain);
  EXPECT_EQ(robot_file_text(again), text);
  EXPECT_EQ(again.name, robot.name);
  EXPECT_EQ(again.payloads.at("run 7.csv").value, 1.5);
  EXPECT_EQ(again.log.columns.at("t").unit, "ms");
}

TEST(RobotFile, IdentifiedRobotRoundTripsExactly) {
  Robot robot = robot_from_toml(kFull, "r.toml");
  robot.identified = true;
  robot.torque_phi = 1.0 / 3.0;
  robot.chain.length[1] = 0.1 + 0.2;
  robot.chain.links[1].mass = std::nextafter(1.7, 2.0);
  robot.chain.links[1].first_moment = {1.0 / 7.0, -1e-17, 3e22};
  robot.chain.links[1].inertia(0, 1) = robot.chain.links[1].inertia(1, 0) = 1.0 / 9.0;
  robot.chain.friction[0] = {2.0 / 3.0, 1.1, -0.3, 1e-4};
  robot.chain.friction[1].viscous = -1e-3;  // what noise may make of a joint without friction
  robot.chain.links[0].mass = -0.2;         // one choice among those that move alike
  const Robot again = robot_from_toml(robot_file_text(robot), "again");
  EXPECT_TRUE(again.identified);
  EXPECT_EQ(again.torque_phi, robot.torque_phi);
  expect_same_chain(robot.chain, again.chain);
}

TEST(RobotFile, CouplingRoundTripsExactly) {
  Robot robot = preset_robot("RR");
  robot.log.coupling.resize(2, 2);
  robot.log.coupling << 1.0, 0.0, -1.0 / 3.0, 2.0;
  EXPECT_EQ(robot_from_toml(robot_file_text(robot), "again").log.coupling, robot.log.coupling);
}

TEST(RobotFile, FieldsOfMessagesRoundTripWithTheNumberOfTheJointInTopicAndField) {
  const Robot robot = robot_from_toml(
      "axes = \"RR\"\n[log.columns]\nq = {topic = \"/arm\", field = \"drives[#].angle\", first = 0, unit = \"deg\"}\n"
      "tau = {topic = \"/joint#/state\", field = \"effort\"}\n",
      "r.toml");
  const Robot again = robot_from_toml(robot_file_text(robot), "again");
  for (const Robot* read : {&robot, &again}) {
    EXPECT_EQ(read->log.columns.at("q2").name, "/arm/drives[1].angle");
    EXPECT_EQ(read->log.columns.at("q2").topic, "/arm");
    EXPECT_EQ(read->log.columns.at("q2").unit, "deg");
    EXPECT_EQ(read->log.columns.at("tau1").name, "/joint1/state/effort");
    ASSERT_EQ(read->log.recording.fields.size(), 4U);
    EXPECT_EQ(read->log.recording.fields[3].topic, "/joint2/state");
    EXPECT_EQ(read->log.recording.fields[3].field, "effort");
  }
}

TEST(RobotFile, EveryPresetRoundTrips) {
  for (const char* axes : {"RRP", "RRPR", "RPRR", "RR", "R", "P"}) {
    const Robot robot = preset_robot(axes);
    const Robot again = robot_from_toml(robot_file_text(robot), axes);
    EXPECT_EQ(again.axes, axes);
    EXPECT_EQ(again.shapes, robot.shapes);
    expect_same_chain(robot.chain, again.chain);
  }
}

TEST(RobotFile, ReadsAChainJointByJoint) {
  const Robot robot = robot_from_toml(R"(
[[joint]]
kind = "revolute"
axis = [0, 0, 2]
[[joint]]
kind = "revolute"
axis = [0, 1, 0]
offset = [0, 0, 0.4]
friction = {viscous = 0.5}
[[joint]]
kind = "prismatic"
axis = [1, 0, 0]
[[link]]
shape = "general"
mass = 3
centre = [0, 0, 0.2]
inertia = [0.3, 0.2, 0.1]
[[link]]
mass = 2
length = 0.5
[[link]]
mass = 0.7
)",
                                      "r.toml");
  EXPECT_EQ(robot.axes, "");
  EXPECT_EQ(robot.chain.geometry[0].axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(robot.chain.geometry[1].direction, Eigen::Vector3d::Zero());
  EXPECT_EQ(robot.chain.geometry[2].direction, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(robot.chain.links[0].inertia(0, 0), 0.3 + 3 * 0.04, 1e-15);
  EXPECT_EQ(robot.chain.friction[1].viscous, 0.5);
  EXPECT_EQ(robot.chain.links[2].mass, 0.7);
  expect_same_chain(robot.chain, robot_from_toml(robot_file_text(robot), "again").chain);
}

TEST(RobotFile, ItsColumnsMayHoldAStopFlag) {
  const Robot robot =
      robot_from_toml("axes = \"RP\"\n[log.columns]\nstop = \"E-Stop active\"\nq1 = \"J1\"\n", "r.toml");
  EXPECT_EQ(robot.log.columns.at("stop").name, "E-Stop active");
  const Robot again = robot_from_toml(robot_file_text(robot), "again");
  EXPECT_EQ(again.log.columns.at("stop").name, "E-Stop active");
}

}  // namespace
}  // namespace faultline
