// SPDX-License-Identifier: MIT
#include "lib/simulate/spec_file.hpp"

#include <gtest/gtest.h>

#include "lib/core/error.hpp"

namespace faultline {
namespace {

const char* const kSpec = R"(
format = "csv"
seed = 10
duration_s = 2.0
sample_period_s = 0.01
control_period_s = "held"
[robot]
name = "bench"
axes = "RRP"
[robot.known]
m1 = 1.0
m2 = 0.8
m3 = 0.5
[noise]
q = 1e-4
dq = [5e-3, 5e-3, 1e-3]
[motion]
profile = "trapezoidal"
low = [-1, -1, -0.3]
high = [1, 1, 0.0]
move_s = [1.0, 1.5]
[[run]]
name = "healthy"
[[run]]
name = "bad"
seed = 77
duration_s = 1.5
motion = {profile = "quintic"}
controller = {mass_error_std = 0.05}
fault = {kind = "collision", joint = 2, onset_s = 0.7051, duration_s = 0.05, size = 9.0}
)";

SimulationFile parse(const std::string& text) { return simulation_from_toml(text, "spec.toml", "."); }

void expect_error(const std::string& text, const std::vector<std::string>& parts) {
  try {
    parse(text);
    FAIL() << "no error for " << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << " in: " << error.what();
  }
}

TEST(SpecFile, RunsInheritTheKeysOfTheFileAndMayReplaceThem) {
  const SimulationFile file = parse(kSpec);
  EXPECT_EQ(file.robot.chain.links[1].mass, 0.8);
  ASSERT_EQ(file.runs.size(), 2u);
  const RunSpec &healthy = file.runs[0], &bad = file.runs[1];
  EXPECT_EQ(healthy.seed, 10u);
  EXPECT_EQ(bad.seed, 77u);
  EXPECT_EQ(healthy.simulation.control_period_s, 0.01);
  EXPECT_EQ(healthy.simulation.motion.profile, MotionProfile::trapezoidal);
  EXPECT_EQ(bad.simulation.motion.profile, MotionProfile::quintic);
  EXPECT_EQ(bad.simulation.motion.move_max_s, 1.5);
  EXPECT_EQ(bad.simulation.duration_s, 1.5);
  EXPECT_EQ(healthy.simulation.noise.q, (std::vector<double>{1e-4, 1e-4, 1e-4}));
  EXPECT_EQ(bad.simulation.controller.mass_error.size(), 3u);
  ASSERT_EQ(bad.simulation.faults.size(), 1u);
  EXPECT_DOUBLE_EQ(bad.simulation.faults[0].end_s, 0.7551);
  EXPECT_TRUE(healthy.simulation.faults.empty());
}

TEST(SpecFile, HeldControlHasTheSamplePeriodOfTheRun) {
  const SimulationFile file = parse(
      "robot = {axes = \"RRP\"}\ncontrol_period_s = \"held\"\n[[run]]\nname = \"a\"\nsample_period_s = 0.02\n"
      "[[run]]\nname = \"b\"\nsample_period_s = 0.02\ncontrol_period_s = 0.01");
  EXPECT_EQ(file.runs[0].simulation.control_period_s, 0.02);
  EXPECT_EQ(file.runs[1].simulation.control_period_s, 0.01);
}

TEST(SpecFile, SeedCanBeOverridden) {
  const SimulationFile file = simulation_from_toml(kSpec, "spec.toml", ".", 500);
  EXPECT_EQ(file.runs[0].seed, 500u);
  EXPECT_EQ(file.runs[1].seed, 77u);  // the run's own seed stays
}

TEST(SpecFile, LabelsHoldTheTrueFaults) {
  const SimulationFile file = parse(kSpec);
  const SimulatedRun healthy = simulate(file.robot, file.runs[0].simulation, file.runs[0].seed);
  EXPECT_EQ(label_lines(file, file.runs[0], healthy),
            "healthy.csv,none,0,,,bench,,,,10,0.01,0.01,2,complete\n");
  const SimulatedRun bad = simulate(file.robot, file.runs[1].simulation, file.runs[1].seed);
  EXPECT_EQ(label_lines(file, file.runs[1], bad),
            "bad.csv,collision,2,0.7051,0.7551,bench,9,N m,,77,0.01,0.01,1.5,complete\n");
  EXPECT_EQ(labels_header().substr(0, 30), "file,fault,joint,onset_s,end_s");
}

TEST(SpecFile, ErrorsNameLineAndKey) {
  expect_error("axes = 1", {"robot is missing"});
  expect_error("robot = {axes = \"RRP\"}", {"no [[run]]"});
  expect_error("robot = {axes = \"RRP\"}\n[[runs]]\nname = \"a\"", {"no [[run]]", "\"runs\""});
  expect_error("robot = {axes = \"RRP\"}\n[[run]]\nnam = \"a\"", {"key run[1]: ", "\"nam\""});
  expect_error("robot = {axes = \"RRP\"}\n[[run]]\nname = \"a/b\"", {"line 3", "name", "a/b"});
  expect_error("robot = {axes = \"RRP\"}\n[[run]]\nname = \"a\"\n[[run]]\nname = \"a\"",
               {"line 5", "two runs"});
  expect_error("robot = {axes = \"RRP\"}\n[[run]]\nname = \"a\"\nduratoin_s = 2",
               {"spec.toml, line 4, key run[1].duratoin_s", "did you mean \"duration_s\""});
  expect_error("robot = {axes = \"RRP\", gravty = 1}\n[[run]]\nname = \"a\"",
               {"robot.gravty", "\"gravity\""});
  expect_error("robot = {axes = \"RRP\"}\n[[run]]\nname = \"a\"\nfault = {kind = \"lockd\"}",
               {"line 4", "kind", "did you mean \"locked\""});
  expect_error(
      "robot = {axes = \"RRP\"}\n[[run]]\nname = \"a\"\nfault = {kind = \"locked\", joint = 4, onset_s = 1}",
      {"line 4, key run[1].fault.joint", "1 to 3", "found 4"});
  expect_error("robot = {axes = \"RRP\"}\n[[run]]\nname = \"a\"\nfault = {kind = \"locked\", joint = 2}",
               {"onset_s", "missing"});
  expect_error(
      "robot = {axes = \"RRP\"}\nsample_period_s = 0.01\ncontrol_period_s = 0.003\n[[run]]\nname = \"a\"",
      {"run \"a\"", "control_period_s", "whole number"});
}

TEST(SpecFile, MissingRobotFileIsNamed) {
  try {
    simulation_from_toml("robot = \"nowhere.toml\"\n[[run]]\nname = \"a\"", "spec.toml", "/nonexistent");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("nowhere.toml"), std::string::npos);
  }
}

}  // namespace
}  // namespace faultline
