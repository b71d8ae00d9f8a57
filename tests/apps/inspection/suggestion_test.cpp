// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "lib/core/atomic_file.hpp"
#include "lib/core/random.hpp"
#include "lib/robot/robot_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

constexpr double kDegrees = 180.0 / M_PI;

/// How the log of an arm that turns and a slide that carries a weight is written.
struct Dialect {
  std::string header = "t,q1,q2,dq1,dq2,tau1,tau2";
  double time = 1.0, angle = 1.0, angular_speed = 1.0, length = 1.0, speed = 1.0, torque = 1.0;
};

std::string log_text(const Dialect& dialect) {
  std::string text = dialect.header + "\n";
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.01 * i, a = 3.0 * t, b = 2.0 * t, c = 7.0 * t;
    const double row[] = {dialect.time * t,
                          dialect.angle * (1.2 * std::sin(a) + 0.2 * std::sin(c)),
                          dialect.length * (0.1 * std::sin(b) - 0.2),
                          dialect.angular_speed * (3.6 * std::cos(a) + 1.4 * std::cos(c)),
                          dialect.speed * 0.2 * std::cos(b),
                          dialect.torque * (-10.8 * std::sin(a) - 9.8 * std::sin(c) + 0.1 * random.normal()),
                          24.5 - std::sin(b) + 0.1 * random.normal()};
    for (const double& value : row) text += (&value == row ? "" : ",") + std::to_string(value);
    text += "\n";
  }
  return text;
}

/// The suggested robot; inspecting the log with it finds nothing severe.
Robot suggested(const std::string& text) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", text), robot = folder.file("robot.toml");
  run_program({"inspect", log, "--suggest", robot});
  EXPECT_EQ(run_program({"inspect", log, "--robot", robot}).status, 0);
  return load_robot_file(robot);
}

const ColumnSpec& column(const Robot& robot, const char* channel) { return robot.log.columns.at(channel); }

TEST(Suggestion, ALogInSiNeedsNoUnits) {
  const Robot robot = suggested(log_text({}));
  EXPECT_EQ(robot.axes, "RP");
  for (const auto& [channel, spec] : robot.log.columns) {
    EXPECT_EQ(spec.unit, "") << channel;
    EXPECT_EQ(spec.sign, 1.0) << channel;
    EXPECT_EQ(spec.name, channel);
  }
}

TEST(Suggestion, DegreesAndMillimetresAreRecognised) {
  Dialect dialect;
  dialect.angle = dialect.angular_speed = kDegrees;
  dialect.length = dialect.speed = 1000.0;
  const Robot robot = suggested(log_text(dialect));
  EXPECT_EQ(robot.axes, "RP");
  EXPECT_EQ(column(robot, "q1").unit, "deg");
  EXPECT_EQ(column(robot, "dq1").unit, "deg/s");
  EXPECT_EQ(column(robot, "q2").unit, "mm");
  EXPECT_EQ(column(robot, "dq2").unit, "mm/s");
}

TEST(Suggestion, DegreesBesideRadiansPerSecondAreRecognised) {
  Dialect dialect;
  dialect.angle = kDegrees;
  const Robot robot = suggested(log_text(dialect));
  EXPECT_EQ(column(robot, "q1").unit, "deg");
  EXPECT_EQ(column(robot, "dq1").unit, "");
}

TEST(Suggestion, MillisecondsAndMicrosecondsAreRecognised) {
  Dialect dialect;
  dialect.time = 1e3;
  EXPECT_EQ(column(suggested(log_text(dialect)), "t").unit, "ms");
  dialect.time = 1e6;
  EXPECT_EQ(column(suggested(log_text(dialect)), "t").unit, "us");
}

TEST(Suggestion, WrongSignsAreRecognised) {
  Dialect dialect;
  dialect.angular_speed = dialect.torque = -1.0;
  const Robot robot = suggested(log_text(dialect));
  EXPECT_EQ(column(robot, "dq1").sign, -1.0);
  EXPECT_EQ(column(robot, "tau1").sign, -1.0);
  EXPECT_EQ(column(robot, "tau2").sign, 1.0);
}

TEST(Suggestion, ColumnsWithMeaninglessNamesAreRecognisedByTheirData) {
  Dialect dialect;
  dialect.header = "ca,cb,cc,cd,ce,cf,cg";
  const Robot robot = suggested(log_text(dialect));
  EXPECT_EQ(robot.axes, "RP");
  EXPECT_EQ(column(robot, "t").name, "ca");
  EXPECT_EQ(column(robot, "q1").name, "cb");
  EXPECT_EQ(column(robot, "q2").name, "cc");
  EXPECT_EQ(column(robot, "dq1").name, "cd");
  EXPECT_EQ(column(robot, "tau2").name, "cg");
}

TEST(Suggestion, ATorqueColumnInAmperesIsSuggestedAsACurrent) {
  Dialect dialect;
  dialect.header = "t,q1,q2,dq1,dq2,tau1 [A],tau2 [A]";
  const Robot robot = suggested(log_text(dialect));
  EXPECT_EQ(robot.log.torque, TorqueMeaning::current);
}

TEST(Suggestion, AxesOfRecordedLogsAreRecognised) {
  const auto folder = shared_data();
  if (folder.empty()) return;
  for (const auto& [log, axes] : {std::pair{"independent-simulation/t_000.csv", "RRP"},
                                  {"living/B_00.csv", "RRP"},
                                  {"double-pendulum/acrobot_undisturbed_01.csv", "RR"},
                                  {"emps/DATA_EMPS.csv", "P"}}) {
    const std::string path = (std::filesystem::path(folder) / log).string();
    if (!std::filesystem::exists(path)) continue;
    EXPECT_EQ(robot_from_toml(run_program({"inspect", path, "--suggest", "-"}).out, log).axes, axes) << log;
  }
}

TEST(Suggestion, StandardOutputHoldsOnlyTheRobotFile) {
  const TemporaryFolder folder;
  const ProgramRun run = run_program({"inspect", folder.write("run.csv", log_text({})), "--suggest", "-"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(robot_from_toml(run.out, "it").axes, "RP");
}

TEST(Suggestion, AnOutputThatIsTheLogIsRefusedAndSoAreTwoLogs) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", log_text({}));
  EXPECT_EQ(run_program({"inspect", log, "--suggest", log}).status, 2);
  EXPECT_EQ(read_file(log), log_text({}));
  EXPECT_EQ(run_program({"inspect", log, log, "--suggest", folder.file("robot.toml")}).status, 2);
}

TEST(Suggestion, ATableWithoutPositionsIsRefusedWithAdvice) {
  const TemporaryFolder folder;
  const ProgramRun run =
      run_program({"inspect", folder.write("run.csv", "a,b\n1,2\n3,4\n"), "--suggest", "-"});
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("[log.columns] q1"), std::string::npos) << run.err;
}

TEST(Suggestion, ColumnsBeyondTheFirst256AreIgnored) {
  const TemporaryFolder folder;
  std::string header, row;
  for (int i = 0; i < 300; ++i) header += "x" + std::to_string(i) + "p,", row += "1,";
  const auto log = [&](const std::string& before, const std::string& after) {
    std::string text = before + header + after + "\n";
    for (int i = 0; i < 50; ++i)
      text += std::to_string(0.01 * i) + "," + row + std::to_string(0.1 * i) + "\n";
    return folder.write("run.csv", text);
  };
  EXPECT_EQ(run_program({"inspect", log("t,", "q1"), "--suggest", "-"}).status, 3);
  EXPECT_LE(run_program({"inspect", log("q1,", "t"), "--suggest", "-"}).status, 3);
}

TEST(Suggestion, HostileNamesStayQuoted) {
  Dialect dialect;
  dialect.header = "t,\"q1\"\"]\\x\",q2,dq1,dq2,tau1,tau2";
  const TemporaryFolder folder;
  const ProgramRun run =
      run_program({"inspect", folder.write("run.csv", log_text(dialect)), "--suggest", "-"});
  EXPECT_NE(run.status, 4) << run.err;
  if (run.status == 0) robot_from_toml(run.out, "it");
}

/// What such a robot's real-time interface exports: a counter, and temperatures that hardly change.
std::string log_without_positions(const std::string& time_name, bool with_angles) {
  std::string text = "Num," + time_name;
  for (const char* joint : {"J1", "J2"})
    text += std::string(",Current_") + joint + ",Temperature_" + joint + ",Speed_" + joint +
            (with_angles ? std::string(",Angle_") + joint : "");
  text += "\n";
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double t = 0.01 * i;
    text += std::to_string(i + 1) + "," + std::to_string(t);
    for (const double speed : {1.0, 2.0}) {
      for (const double value :
           {-2.0 + std::sin(speed * t) + 0.05 * random.normal(), 27.8 + 1e-4 * i, 0.3 * std::cos(speed * t)})
        text += "," + std::to_string(value);
      if (with_angles) text += "," + std::to_string(0.3 / speed * std::sin(speed * t));
    }
    text += "\n";
  }
  return text;
}

TEST(Suggestion, CountersTemperaturesAndCurrentsAreNotTakenForPositions) {
  const TemporaryFolder folder;
  for (const char* time : {"Timestamp", "Zeile"}) {
    const std::string log = folder.write("run.csv", log_without_positions(time, false));
    const ProgramRun run = run_program({"inspect", log, "--suggest", "-"});
    EXPECT_EQ(run.status, 3) << run.out;
    EXPECT_NE(run.err.find("no column could be identified as a joint's position"), std::string::npos)
        << run.err;
  }
}

TEST(Suggestion, ColumnsBesideACounterAndTemperaturesAreFoundByTheirNames) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", log_without_positions("Timestamp", true));
  run_program({"inspect", log, "--suggest", folder.file("robot.toml")});
  const Robot robot = load_robot_file(folder.file("robot.toml"));
  EXPECT_EQ(column(robot, "q1").name, "Angle_J1");
  EXPECT_EQ(column(robot, "dq2").name, "Speed_J2");
  for (const auto& [channel, spec] : robot.log.columns)
    EXPECT_EQ(spec.name.find("Temperature"), std::string::npos) << channel;
}

}  // namespace
}  // namespace faultline
