// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

const std::string kLog = "t,q1,dq1,tau1\n0,0,1,2\n0.01,0.01,1,2.5\n0.02,0.02,1,3\n0.03,0.03,1,2\n";

class BadLearning : public testing::Test {
 protected:
  BadLearning() { robot_ = folder_.write("robot.toml", "axes = \"P\"\n"); }

  ProgramRun learn(const std::string& log, const std::string& labels = "", const std::string& out = "") {
    std::vector<std::string> arguments = {"learn",   folder_.write("log.csv", log),
                                          "--robot", robot_,
                                          "-o",      out.empty() ? folder_.file("robot.model") : out};
    if (!labels.empty()) arguments.insert(arguments.end(), {"--labels", folder_.write("labels.csv", labels)});
    return run_program(arguments);
  }

  void expect_refused(const ProgramRun& run, int status, const std::vector<std::string>& words) {
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_EQ(run.out, "");
    for (const std::string& word : words)
      EXPECT_NE(run.err.find(word), std::string::npos) << word << " in: " << run.err;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      EXPECT_EQ(entry.path().filename().string().find("robot.model"), std::string::npos) << entry.path();
  }

  TemporaryFolder folder_;
  std::string robot_;
};

TEST_F(BadLearning, LearnRefusesOneTinyLog) { expect_refused(learn(kLog), 3, {"log.csv"}); }

TEST_F(BadLearning, LearnRefusesALogOfOneRow) {
  expect_refused(learn("t,q1,dq1,tau1\n0,0,1,2\n"), 3, {"log.csv"});
}

TEST_F(BadLearning, LearnRefusesALogOfAnotherRobot) {
  expect_refused(learn("t,q1,q2,tau1,tau2\n0,0,1,2,3\n1,0,1,2,3\n"), 3, {"log.csv", "2 joints"});
}

/// A joint that swings by `reach` in each direction, for 20 s at 500 Hz.
std::string swinging(double reach) {
  std::string text = "t,q1,dq1,tau1\n";
  for (int i = 0; i < 10000; ++i) {
    const double t = 0.002 * i;
    text += std::to_string(t) + "," + std::to_string(reach * std::sin(t)) + "," +
            std::to_string(reach * std::cos(t)) + "," + std::to_string(std::sin(t) + std::cos(t)) + "\n";
  }
  return text;
}

/// Returns the processor time of the programs that ended so far.
double time_of_programs_s() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

TEST_F(BadLearning, DegreesTakenForRadiansAreRefusedBeforeAnyWork) {
  robot_ = folder_.write("robot.toml", "axes = \"R\"\n[known]\nl1 = 0.3\n");
  const std::vector<std::string> words = {"log.csv", "q1 is between -45 and 45", "hardly in rad",
                                          "[log.columns] q1 = {unit = \"deg\"}", "--force"};
  const double before_s = time_of_programs_s();
  expect_refused(learn(swinging(45.0)), 3, words);
  const std::vector<std::string> identify = {"identify", folder_.file("log.csv"),    "--robot", robot_,
                                             "-o",       folder_.file("robot.model")};
  expect_refused(run_program(identify), 3, words);
  EXPECT_LT(time_of_programs_s() - before_s, 5.0) << "both before any work";

  std::vector<std::string> forced = identify;
  forced.push_back("--force");
  EXPECT_LE(run_program(forced).status, 1);
  folder_.write("robot.toml",
                "axes = \"R\"\n[known]\nl1 = 0.3\n[log.columns]\nq1 = {unit = \"deg\"}\n"
                "dq1 = {unit = \"deg/s\"}\n");
  EXPECT_LE(run_program(identify).status, 1) << "with the unit that the sentence asks for";
}

TEST_F(BadLearning, MillimetresTakenForMetresAreRefused) {
  expect_refused(learn(swinging(80.0)), 3, {"q1 is between -80 and 80", "hardly in m", "unit = \"mm\""});
}

TEST_F(BadLearning, LearnRefusesALogWithoutTorque) {
  expect_refused(learn("t,q1,dq1\n0,0,1\n0.01,0,1\n"), 3, {"log.csv", "torque"});
}

TEST_F(BadLearning, LearnRefusesLabelsWithoutARequiredColumn) {
  expect_refused(learn(kLog, "file,fault\nlog.csv,none\n"), 3, {"labels.csv", "\"joint\"", "onset_s"});
}

TEST_F(BadLearning, LearnRefusesLabelsWithoutAFinalLineBreak) {
  expect_refused(learn(kLog, "file,fault,joint,onset_s\nlog.csv,locked,1,1"), 3,
                 {"labels.csv", "line break"});
}

TEST_F(BadLearning, LearnRefusesEmptyLabels) {
  expect_refused(learn(kLog, "\n"), 3, {"labels.csv", "\"file\""});
}

TEST_F(BadLearning, LearnRefusesLabelsWithAnUnknownFault) {
  expect_refused(learn(kLog, "file,fault,joint,onset_s\nlog.csv,broken,1,2\n"), 3,
                 {"labels.csv", "row 2", "broken", "locked"});
}

TEST_F(BadLearning, LearnRefusesLabelsWithTextInPlaceOfANumber) {
  expect_refused(learn(kLog, "file,fault,joint,onset_s\nlog.csv,locked,1,soon\n"), 3,
                 {"labels.csv", "row 2, column onset_s", "\"soon\""});
}

TEST_F(BadLearning, LearnRefusesLabelsWithAShortRow) {
  expect_refused(learn(kLog, "file,fault,joint,onset_s\nlog.csv,locked\n"), 3, {"labels.csv", "row 2"});
}

TEST_F(BadLearning, LearnRefusesLabelsWithAnInvalidJointNumber) {
  for (const char* joint : {"1.5", "-1", "nan", "1e30"})
    expect_refused(learn(kLog, std::string("file,fault,joint,onset_s\nlog.csv,locked,") + joint + ",2\n"), 3,
                   {"labels.csv", "row 2, column joint", joint});
}

TEST_F(BadLearning, LearnRefusesLabelsWithAJointThatTheRobotLacks) {
  expect_refused(learn(kLog, "file,fault,joint,onset_s\nlog.csv,locked,4,2\n"), 2,
                 {"log.csv", "joint 4", "1 joint"});
}

TEST_F(BadLearning, LearnRefusesLogsThatAreAllFaulty) {
  expect_refused(learn(kLog, "file,fault,joint,onset_s\nlog.csv,locked,1,0.02\n"), 2, {"healthy"});
}

TEST_F(BadLearning, LearnRefusesAMissingOutputFolder) {
  expect_refused(learn(kLog, "", folder_.file("no/robot.model")), 3, {"no/robot.model", "cannot be created"});
}

}  // namespace
}  // namespace faultline
