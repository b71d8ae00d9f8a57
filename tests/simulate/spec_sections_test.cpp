// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/simulate/spec_file.hpp"

namespace faultline {
namespace {

const std::string kRobot = "robot = {axes = \"RRP\"}\nduration_s = 1\n";
const std::string kRun = "\n[[run]]\nname = \"a\"\n";

SimulationFile parse(const std::string& text) { return simulation_from_toml(text, "spec.toml", "."); }

SimulationSpec spec_with(const std::string& sections) {
  return parse(kRobot + sections + kRun).runs.at(0).simulation;
}

using Numbers = std::vector<double>;

TEST(SpecSections, GearsAndFrictionAreRead) {
  const MachineSpec machine = spec_with(R"(
[gears]
stiffness = [9000, 4000, 0]
damping = [20, 10, 0]
play = [1e-4, 2e-4, 0]
motor_inertia = 1.5
[stick_slip]
share = 0.4
speed = [0.05, 0.05, 0.01]
[warm_up]
share = [0.3, 0, 0]
time_s = 600)")
                                  .machine;
  EXPECT_EQ(machine.gears.stiffness, (Numbers{9000, 4000, 0}));
  EXPECT_EQ(machine.gears.damping, (Numbers{20, 10, 0}));
  EXPECT_EQ(machine.gears.play, (Numbers{1e-4, 2e-4, 0}));
  EXPECT_EQ(machine.gears.motor_inertia, (Numbers{1.5, 1.5, 1.5}));
  EXPECT_EQ(machine.stick_slip.share, (Numbers{0.4, 0.4, 0.4}));
  EXPECT_EQ(machine.stick_slip.speed, (Numbers{0.05, 0.05, 0.01}));
  EXPECT_EQ(machine.warm_up.share, (Numbers{0.3, 0, 0}));
  EXPECT_EQ(machine.warm_up.time_s, (Numbers{600, 600, 600}));
}

TEST(SpecSections, DrivesAreRead) {
  const DriveSpec drives = spec_with(R"(
[drives]
gain = [0.02, 0, 0]
limit = [20, 10, 60])")
                               .drives;
  EXPECT_EQ(drives.gain, (Numbers{0.02, 0, 0}));
  EXPECT_EQ(drives.limit, (Numbers{20, 10, 60}));
}

TEST(SpecSections, WorkPieceAndRecordingAreRead) {
  const SimulationSpec spec = spec_with(R"(
[work_piece]
mass = 0.6
carried_s = [0.5, 2]
empty_s = [1, 4]
[recording]
jitter_s = 2e-4
stamp_resolution_s = 1e-3
lost = 0.002
torque_late_rows = 2
velocity_filter_s = 0.005
torque_resolution = [0.1, 0.1, 0.5]
velocity = "difference")");
  EXPECT_EQ(spec.work_piece.mass, 0.6);
  EXPECT_EQ(spec.work_piece.carried_min_s, 0.5);
  EXPECT_EQ(spec.work_piece.carried_max_s, 2.0);
  EXPECT_EQ(spec.work_piece.empty_min_s, 1.0);
  EXPECT_EQ(spec.work_piece.empty_max_s, 4.0);
  EXPECT_EQ(spec.recording.jitter_s, 2e-4);
  EXPECT_EQ(spec.recording.stamp_resolution_s, 1e-3);
  EXPECT_EQ(spec.recording.lost, 0.002);
  EXPECT_EQ(spec.recording.torque_late_rows, 2);
  EXPECT_EQ(spec.recording.velocity_filter_s, 0.005);
  EXPECT_EQ(spec.recording.torque_resolution, (Numbers{0.1, 0.1, 0.5}));
  EXPECT_EQ(spec.recording.velocity, RecordedVelocity::difference);
}

TEST(SpecSections, ARunReplacesSingleKeys) {
  const SimulationFile file =
      parse(kRobot + "[work_piece]\nmass = 0.6\nempty_s = [1, 4]\n" + kRun +
            "work_piece = {mass = 0}\nrecording = {lost = 0.1}\n[[run]]\nname = \"b\"\n");
  EXPECT_EQ(file.runs[0].simulation.work_piece.mass, 0.0);
  EXPECT_EQ(file.runs[0].simulation.work_piece.empty_max_s, 4.0);
  EXPECT_EQ(file.runs[0].simulation.recording.lost, 0.1);
  EXPECT_EQ(file.runs[1].simulation.work_piece.mass, 0.6);
  EXPECT_EQ(file.runs[1].simulation.recording.lost, 0.0);
}

void expect_error(const std::string& sections, const std::vector<std::string>& parts) {
  try {
    spec_with(sections);
    FAIL() << "no error for " << sections;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::usage);
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << " in: " << error.what();
  }
}

TEST(SpecSections, InvalidValuesAndKeysAreNamed) {
  for (const char* key : {"stiffness", "damping", "play", "motor_inertia"})
    expect_error(std::string("[gears]\n") + key + " = [1, 2]", {"line 4", std::string("gears.") + key});
  for (const char* key :
       {"stick_slip.share", "stick_slip.speed", "warm_up.share", "warm_up.time_s", "work_piece.mass",
        "work_piece.carried_s", "work_piece.empty_s", "recording.jitter_s", "recording.stamp_resolution_s",
        "recording.lost", "recording.torque_late_rows", "recording.torque_resolution", "recording.velocity",
        "recording.velocity_filter_s"})
    expect_error(std::string(key) + " = \"much\"", {"line 3", key});
  expect_error("[recording]\nvelocity = \"differ\"", {"recording.velocity", "difference"});
  expect_error("[recording]\njitter = 1e-3", {"recording.jitter", "did you mean \"jitter_s\""});
  expect_error("[recording]\ntorque_late_rows = 1.5", {"recording.torque_late_rows"});
}

TEST(SpecSections, InconsistentValuesAreNamedWithTheirRun) {
  expect_error("[gears]\nstiffness = 5000", {"run \"a\"", "gears.motor_inertia"});
  expect_error("[gears]\nplay = 0.001", {"run \"a\"", "gears.play", "rigid"});
  expect_error("[gears]\ndamping = 1", {"run \"a\"", "gears.damping", "rigid"});
  expect_error("[gears]\nstiffness = -1", {"run \"a\"", "gears.stiffness"});
  expect_error("[stick_slip]\nshare = 0.2", {"run \"a\"", "stick_slip.speed"});
  expect_error("[warm_up]\nshare = 0.2", {"run \"a\"", "warm_up.time_s"});
  expect_error("[work_piece]\nmass = -1", {"run \"a\"", "work_piece.mass"});
  expect_error("[work_piece]\ncarried_s = [3, 1]", {"run \"a\"", "work_piece.carried_s"});
  expect_error("[recording]\nstamp_resolution_s = 1", {"run \"a\"", "recording.stamp_resolution_s"});
  expect_error("[recording]\nlost = 2", {"run \"a\"", "recording.lost"});
}

/// The examples of docs/simulate.md; a robot file they name is replaced by axes.
TEST(SpecSections, ExamplesOfTheDocumentationAreValidSpecs) {
  const std::string page = read_file(FAULTLINE_SOURCE_DIR "/docs/simulate.md");
  const std::string fence = "```toml\n", file_name = "\"robot.toml\"";
  int examples = 0;
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1)) {
    std::string text = page.substr(at + fence.size());
    text.resize(text.find("```"));
    if (const std::size_t named = text.find(file_name); named != std::string::npos)
      text.replace(named, file_name.size(), "\"RRP\"");
    EXPECT_NO_THROW(parse(text)) << text;
    ++examples;
  }
  EXPECT_GE(examples, 2);
}

}  // namespace
}  // namespace faultline
