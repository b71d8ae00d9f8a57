// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lib/core/atomic_file.hpp"
#include "lib/core/hash.hpp"
#include "tests/apps/golden_copy.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

using Json = nlohmann::json;

const std::string kLog = "t,q1,dq1,tau1\n0,0.1,0.25,-3e-300\n0.1,0.125,0.25,2\n0.2,0.15,0.25,0.1\n";

TEST(Inspect, JsonHoldsTheFactsOfTheLog) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", kLog);
  const ProgramRun run = run_program({"inspect", log, "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json.at("schema"), "faultline/inspection/1");
  const Json& found = json.at("logs").at(0);
  EXPECT_EQ(found.at("rows"), 3);
  EXPECT_EQ(found.at("sha256"), sha256_hex(kLog));
  EXPECT_EQ(found.at("joints"), 1);
  EXPECT_EQ(found.at("channels").size(), 3u);
  EXPECT_EQ(found.at("channels").at(0).at("max"), 0.15);
  EXPECT_DOUBLE_EQ(found.at("sample_period_s"), 0.1);
  EXPECT_TRUE(found.at("issues").empty());
}

TEST(Inspect, TheSameLogGivesTheSameBytes) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", kLog);
  EXPECT_EQ(run_program({"inspect", log, "--json", "-"}).out,
            run_program({"inspect", log, "--json", "-"}).out);
}

TEST(Inspect, OutputHasColorsOnlyOnRequest) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", kLog);
  EXPECT_EQ(run_program({"inspect", log}).out.find('\x1b'), std::string::npos);
  EXPECT_NE(run_program({"--color", "always", "inspect", log}).out.find('\x1b'), std::string::npos);
  EXPECT_NE(
      run_program({"inspect", log, "--color", "always"}, {.environment = {"NO_COLOR=1"}}).out.find('\x1b'),
      std::string::npos);
}

TEST(Inspect, RobotFileGivesUnitsAndColumns) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", "clock,slide,vir\n0,0,1\n100,20,2\n200,40,1\n");
  const std::string robot =
      folder.write("robot.toml",
                   "axes = \"P\"\n[log.columns]\nt = {name = \"clock\", unit = \"ms\"}\n"
                   "q1 = {name = \"slide\", unit = \"mm\"}\n"
                   "tau1 = {name = \"vir\", scale = 35.0}\n");
  const ProgramRun run = run_program({"inspect", log, "--robot", robot, "--json", "-"});
  ASSERT_EQ(run.status, 0) << run.err << run.out;
  const Json found = Json::parse(run.out).at("logs").at(0);
  EXPECT_DOUBLE_EQ(found.at("end_s"), 0.2);
  EXPECT_EQ(found.at("channels").at(0).at("unit"), "m");
  EXPECT_DOUBLE_EQ(found.at("channels").at(0).at("max"), 0.04);
  EXPECT_EQ(found.at("channels").at(1).at("unit"), "N");
  EXPECT_EQ(found.at("channels").at(1).at("max"), 70.0);
}

TEST(Inspect, DiagnoseDerivesTheVelocitiesThatInspectAnnounces) {
  const TemporaryFolder folder;
  const std::string golden = std::string(FAULTLINE_SOURCE_DIR) + "/sample_logs/golden/";
  const std::string log = read_file(golden + "logs/locked_1.csv");
  const auto without = [&](const std::string& prefix) {
    std::istringstream lines(log);
    std::string text, line, cell;
    std::vector<bool> left_out;
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      std::string row;
      for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
        if (text.empty()) left_out.push_back(cell.starts_with(prefix));
        if (!left_out[i]) row += (row.empty() ? "" : ",") + cell;
      }
      text += row + "\n";
    }
    return text;
  };
  const std::string path = folder.write("run.csv", without("dq"));
  EXPECT_NE(run_program({"inspect", path}).out.find("it will be derived"), std::string::npos);
  const GoldenCopy copy;
  const ProgramRun run =
      run_program({"diagnose", path, "--model", copy.file("", "model-"), "--cases", copy.file("", "cases-")});
  EXPECT_EQ(run.status, 1) << run.err;
}

TEST(Inspect, ASlidingAxisOfTheRobotFileGetsMillimetresAsSuggestedUnit) {
  const TemporaryFolder folder;
  std::string text = "t,q1,q2\n";
  for (int i = 0; i < 50; ++i) text += std::to_string(0.01 * i) + ",0.5," + std::to_string(4.0 * i) + "\n";
  const std::string log = folder.write("run.csv", text);
  const ProgramRun run =
      run_program({"inspect", log, "--robot", folder.write("robot.toml", "axes = \"RP\"\n")});
  EXPECT_NE(run.out.find("q2 = {unit = \"mm\"}"), std::string::npos) << run.out;
}

TEST(Convert, CsvToNativeAndBackIsExact) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", kLog);
  const std::string native = folder.file("run.flog"), again = folder.file("again.csv");
  ASSERT_EQ(run_program({"convert", log, native}).status, 0);
  ASSERT_EQ(run_program({"convert", native, again}).status, 0);
  EXPECT_EQ(read_file(again), kLog);
  EXPECT_EQ(run_program({"convert", log, "-"}).out, kLog);
}

TEST(Convert, ReportsTheRowsThatItLeavesOut) {
  const TemporaryFolder folder;
  const ProgramRun run =
      run_program({"convert", folder.write("run.csv", kLog + "0.2,1,1,1\n"), folder.file("out.csv")});
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("time_repeated"), std::string::npos) << run.err;
  EXPECT_NE(run.out.find("3 of 4 rows"), std::string::npos) << run.out;
  EXPECT_EQ(read_file(folder.file("out.csv")).rfind(kLog + "# faultline provenance: ", 0), 0u);
}

std::vector<std::string> all_csv(const std::filesystem::path& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".csv") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(Inspect, EveryRecordedCsvIsRead) {
  const auto folder = shared_data();
  if (folder.empty()) return;
  std::vector<std::string> command{"inspect", "--json", "-"};
  const auto paths = all_csv(folder);
  command.insert(command.end(), paths.begin(), paths.end());
  const ProgramRun run = run_program(command);
  EXPECT_EQ(run.err, "");
  EXPECT_LE(run.status, 1);
  const Json logs = Json::parse(run.out).at("logs");
  ASSERT_EQ(logs.size(), paths.size());
  std::map<std::string, Json> by_name;
  for (const Json& log : logs) by_name[std::filesystem::path(std::string(log.at("path"))).filename()] = log;
  const std::map<std::string, int> joints{{"DATA_EMPS.csv", 1},
                                          {"both_joints_75s.csv", 2},
                                          {"acrobot_perturbed_02.csv", 2},
                                          {"plotjuggler_export.csv", 4},
                                          {"preamble_lines.csv", 1},
                                          {"ros2_topic_echo_statistics.csv", 4},
                                          {"stall_100hz.csv", 1},
                                          {"t_000.csv", 3}};
  for (const auto& [name, count] : joints)
    if (by_name.count(name)) {
      EXPECT_EQ(by_name[name].at("joints"), count) << name;
    }
  for (const char* name : {"labels.csv", "perturbation_labels.csv", "ros2_topic_echo_jtc.csv"})
    if (by_name.count(name)) {
      EXPECT_FALSE(by_name[name].at("joint_log")) << name;
    }
}

}  // namespace
}  // namespace faultline
