// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "formats/open_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/log/log.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/simulate/spec_file.hpp"

/// The committed sample logs are what the committed specs make.
namespace faultline {
namespace {

const std::string kSamples = FAULTLINE_SOURCE_DIR "/sample_logs/";

std::string made_by_program(const std::string& robot) {
  const std::string folder = testing::TempDir() + "faultline_samples_" + robot;
  std::filesystem::remove_all(folder);
  const std::string command = std::string(FAULTLINE_PROGRAM) + " simulate " + kSamples + robot +
                              "/spec.toml -o " + folder + " > /dev/null 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  return folder + "/";
}

/// The same channels and numbers, bit for bit; in which version of the format does not count.
void expect_same_rows(const std::string& made, const std::string& kept) {
  Log mine = read_all(*open_log(made)), theirs = read_all(*open_log(kept));
  ASSERT_GT(theirs.rows(), 0) << kept;
  EXPECT_EQ(mine.extra.size(), theirs.extra.size()) << kept;
  EXPECT_EQ(mine.joints(), theirs.joints()) << kept;
  for_each_column(mine, theirs, [&](const std::vector<double>& a, const std::vector<double>& b) {
    EXPECT_TRUE(a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0)
        << kept;
  });
}

void expect_same_logs(const std::string& robot) {
  const std::string folder = made_by_program(robot);
  const SimulationFile file = load_simulation_file(kSamples + robot + "/spec.toml");
  for (const RunSpec& run : file.runs) {
    const std::string name = run.name + "." + file.format;
    const std::string kept = kSamples + robot + "/" + name;
    if (file.format == "flog")
      expect_same_rows(folder + name, kept);
    else
      EXPECT_TRUE(read_file(folder + name) == read_file(kept)) << kept;
  }
  EXPECT_EQ(read_file(folder + "labels.csv"), read_file(kSamples + robot + "/labels.csv"));
  std::filesystem::remove_all(folder);
}

TEST(SampleLogs, BenchLogsEqualTheOutputOfTheirSpec) { expect_same_logs("bench"); }
TEST(SampleLogs, IndustrialLogsEqualTheOutputOfTheirSpec) { expect_same_logs("industrial"); }
TEST(SampleLogs, RrprLogsEqualTheOutputOfTheirSpec) { expect_same_logs("rrpr"); }

TEST(SampleLogs, EveryRobotHasHealthyLogsAndEveryFaultKind) {
  for (const char* robot : {"bench", "industrial", "rrpr"}) {
    const SimulationFile file = load_simulation_file(kSamples + robot + "/spec.toml");
    std::vector<int> runs(kFaultKinds, 0);
    for (const RunSpec& run : file.runs)
      ++runs[run.simulation.faults.empty() ? 0 : static_cast<int>(run.simulation.faults[0].kind)];
    EXPECT_EQ(runs[0], 3) << robot;
    for (int kind = 1; kind < static_cast<int>(FaultKind::unknown); ++kind)
      EXPECT_EQ(runs[kind], 1) << robot << " " << to_string(static_cast<FaultKind>(kind));
  }
}

TEST(SampleLogs, RobotFilesHoldNoTrueMasses) {
  for (const char* robot : {"bench", "industrial", "rrpr"}) {
    const Robot known = load_robot_file(kSamples + robot + "/robot.toml");
    const SimulationFile file = load_simulation_file(kSamples + robot + "/spec.toml");
    EXPECT_EQ(known.axes, file.robot.axes);
    ASSERT_EQ(known.known.size(), 1u);
    EXPECT_EQ(known.known.at("l1").value, file.robot.chain.length[0]);
  }
}

}  // namespace
}  // namespace faultline
