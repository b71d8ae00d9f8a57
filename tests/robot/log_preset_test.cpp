// SPDX-License-Identifier: MIT
#include "lib/robot/log_preset.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "formats/open_log.hpp"
#include "lib/core/error.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

Log read_with(const std::string& robot_text, const std::string& path) {
  const Robot robot = robot_from_toml(robot_text, "robot.toml");
  OpenLogOptions options;
  options.columns = robot.log.columns;
  return read_all(*open_log(path, options));
}

using Values = std::vector<double>;

TEST(LogPreset, UniversalRobotsRtdeMapsPositionsVelocitiesAndTorques) {
  const TemporaryFolder folder;
  const std::string log =
      folder.write("run.csv",
                   "timestamp target_q_0 target_q_1 actual_q_0 actual_q_1 actual_qd_0 actual_qd_1 "
                   "actual_current_0 actual_current_1 target_moment_0 target_moment_1\n"
                   "10.002 9 9 1 2 3 4 5 6 8 8\n10.004 9 9 1.5 2.5 3 4 5 6 8 8\n");
  const Log read = read_with("axes = \"RR\"\n[log]\npreset = \"ur-rtde\"\n", log);
  EXPECT_EQ(read.time, (Values{10.002, 10.004}));
  EXPECT_EQ(read.q[1], (Values{2, 2.5}));
  EXPECT_EQ(read.dq[0], (Values{3, 3}));
  EXPECT_EQ(read.tau[1], (Values{6, 6}));
}

TEST(LogPreset, FrankaCountsMilliseconds) {
  const TemporaryFolder folder;
  const std::string log = folder.write(
      "run.csv",
      "duration, success rate, state.q[0], state.q_d[0], state.dq[0], state.dq_d[0], state.tau_J[0], "
      "cmd.tau_J_d[0]\n1000, 1, 0.5, 9, 0.25, 9, 2, 9\n1001, 1, 0.75, 9, 0.25, 9, 3, 9\n");
  const Log read = read_with("axes = \"R\"\n[log]\npreset = \"franka\"\n", log);
  EXPECT_EQ(read.time[0], 1.0);
  EXPECT_DOUBLE_EQ(read.time[1], 1.001);
  EXPECT_EQ(read.q[0], (Values{0.5, 0.75}));
  EXPECT_EQ(read.tau[0], (Values{2, 3}));
}

TEST(LogPreset, MecademicHasDegreesAndSharesOfTheRatedTorque) {
  const TemporaryFolder folder;
  const std::string log = folder.write(
      "run.csv", "Timestamp,JointPos_1,JointVel_1,JointTorq_1\n1000000,180,90,50\n1001000,90,90,25\n");
  const Log read = read_with("axes = \"R\"\n[log]\npreset = \"mecademic\"\n", log);
  EXPECT_DOUBLE_EQ(read.time[0], 1.0);
  EXPECT_DOUBLE_EQ(read.q[0][0], 2 * read.q[0][1]);
  EXPECT_DOUBLE_EQ(read.tau[0][0], 0.5);
}

TEST(LogPreset, FactoryNetCountsJointsFromZeroAndHasSetpoints) {
  const TemporaryFolder folder;
  const std::string log = folder.write(
      "run.csv",
      "timestamp_ms,setpoint_pos_0,setpoint_pos_1,setpoint_vel_0,setpoint_vel_1,effort_torque_0,effort_torque_1,"
      "effort_current_0,effort_current_1,feedback_pos_0,feedback_pos_1,feedback_vel_0,feedback_vel_1\n"
      "0,1,2,3,4,5,6,9,9,1.5,2.5,3.5,4.5\n8,1,2,3,4,5,6,9,9,1.5,2.5,3.5,4.5\n");
  const Log read = read_with("axes = \"RR\"\n[log]\npreset = \"factorynet\"\n", log);
  EXPECT_EQ(read.time, (Values{0, 0.008}));
  EXPECT_EQ(read.q[1], (Values{2.5, 2.5}));
  EXPECT_EQ(read.q_ref[0], (Values{1, 1}));
  EXPECT_EQ(read.dq[1], (Values{4.5, 4.5}));
  EXPECT_EQ(read.tau[1], (Values{6, 6}));
}

TEST(LogPreset, ServoLoggersCountStepsAndCurrent) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv",
                                       "time,pos (1),load (1),current (1),pos (2),load (2),current (2)\n"
                                       "0,2048,120,100,1024,-80,-200\n0.02,2049,120,100,1024,-80,-200\n");
  for (const auto& [preset, ampere] : {std::pair{"feetech", 0.0065}, std::pair{"dynamixel", 0.00269}}) {
    const std::string robot = std::string("axes = \"RR\"\n[log]\npreset = \"") + preset + "\"\n";
    const Log read = read_with(robot, log);
    EXPECT_DOUBLE_EQ(read.q[0][0], std::numbers::pi) << preset;
    EXPECT_DOUBLE_EQ(read.q[1][0], std::numbers::pi / 2) << preset;
    EXPECT_DOUBLE_EQ(read.tau[1][0], -200 * ampere) << preset;
    EXPECT_EQ(robot_from_toml(robot, "robot.toml").log.torque, TorqueMeaning::current);
  }
}

TEST(LogPreset, TheRobotFileOverridesThePreset) {
  const Robot robot = robot_from_toml(
      "axes = \"RR\"\n[log]\npreset = \"ur-rtde\"\ntorque = \"measured\"\n[log.columns]\nq2 = \"mine\"\n",
      "robot.toml");
  EXPECT_EQ(robot.log.torque, TorqueMeaning::measured);
  EXPECT_EQ(robot.log.columns.at("q1").name, "actual_q_0");
  EXPECT_EQ(robot.log.columns.at("q2").name, "mine");
  EXPECT_EQ(robot_from_toml(robot_file_text(robot), "again").log.columns.at("tau2").name, "actual_current_1");
}

TEST(LogPreset, AFileOfTheUserCanBeAPreset) {
  const TemporaryFolder folder;
  const std::string preset = folder.write(
      "cell.toml", "[log.columns]\nt = \"clock\"\nq = {name = \"axis # pos\", unit = \"deg\"}\n");
  const Robot robot = robot_from_toml("axes = \"RR\"\n[log]\npreset = \"" + preset + "\"\n", "robot.toml");
  EXPECT_EQ(robot.log.columns.at("q2").name, "axis 2 pos");
  EXPECT_EQ(robot.log.columns.at("q2").unit, "deg");
}

TEST(LogPreset, AnUnknownPresetIsRefusedWithTheKnownOnes) {
  try {
    robot_from_toml("axes = \"RR\"\n[log]\npreset = \"kuka\"\n", "robot.toml");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    EXPECT_NE(error.message().find("dynamixel, factorynet, feetech, franka, kuka-trace, mecademic, "
                                   "ur-rtde"),
              std::string::npos)
        << error.message();
  }
}

}  // namespace
}  // namespace faultline
