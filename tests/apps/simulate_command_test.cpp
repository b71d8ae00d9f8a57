// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

const char* const kSpec = R"(
robot = "robot.toml"
duration_s = 1.0
sample_period_s = 0.01
[[run]]
name = "healthy"
[[run]]
name = "bad"
fault = {kind = "locked", joint = 2, onset_s = 0.5}
)";

class SimulateCommand : public testing::Test {
 protected:
  SimulateCommand() {
    write_file(folder_.file("robot.toml"), "axes = \"RRP\"\n");
    write_file(spec_, kSpec);
  }

  ProgramRun simulate(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"simulate", spec_, "-o", out_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(arguments);
  }

  TemporaryFolder folder_;
  std::string spec_ = folder_.file("spec.toml");
  std::string out_ = folder_.file("logs/new");
};

TEST_F(SimulateCommand, WritesLogsAndLabels) {
  const ProgramRun run = simulate();
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("bad.csv"), std::string::npos);
  const std::string labels = read_file(out_ + "/labels.csv");
  EXPECT_NE(labels.find("\nhealthy.csv,none,0,,"), std::string::npos) << labels;
  EXPECT_NE(labels.find("\nbad.csv,locked,2,0.5,1,"), std::string::npos) << labels;
  EXPECT_EQ(read_file(out_ + "/bad.csv").substr(0, 38), "t,q1,q2,q3,dq1,dq2,dq3,tau1,tau2,tau3\n");
}

TEST_F(SimulateCommand, JsonListsRunsAndFaults) {
  const auto json = nlohmann::json::parse(simulate({"--json"}).out);
  EXPECT_EQ(json.at("runs").at(1).at("faults").at(0).at("kind"), "locked");
  EXPECT_EQ(json.at("runs").at(0).at("rows"), 101);
}

TEST_F(SimulateCommand, TheSeedDeterminesTheMotion) {
  simulate();
  const std::string first = read_file(out_ + "/healthy.csv");
  simulate({"--seed", "9"});
  const std::string second = read_file(out_ + "/healthy.csv");
  EXPECT_NE(first, second);
  simulate({"--seed", "9"});
  EXPECT_EQ(read_file(out_ + "/healthy.csv"), second);
}

TEST_F(SimulateCommand, MissingSpecIsAnInputError) {
  const ProgramRun run = run_program({"simulate", folder_.file("none.toml"), "-o", out_});
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("none.toml"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(SimulateCommand, WrongSpecIsAUsageErrorThatNamesTheLine) {
  write_file(spec_, "robot = \"robot.toml\"\n[[run]]\nname = \"a\"\nduration = 2\n");
  const ProgramRun run = simulate();
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("line 4"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("duration_s"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(SimulateCommand, AFileInPlaceOfTheOutputFolderIsRefusedAndKept) {
  std::filesystem::create_directories(folder_.file("logs"));
  write_file(out_, "in the way");
  const ProgramRun run = simulate();
  EXPECT_EQ(run.status, 3);
  EXPECT_EQ(read_file(out_), "in the way");
}

TEST_F(SimulateCommand, AFullDiskLeavesNoPartialLog) {
  RunOptions small;
  small.file_size_limit = 2000;
  const ProgramRun run = run_program({"simulate", spec_, "-o", out_}, small);
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_TRUE(std::filesystem::is_empty(out_));
}

}  // namespace
}  // namespace faultline
