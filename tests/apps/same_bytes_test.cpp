// SPDX-License-Identifier: MIT
// What the program makes of the same input on another processor, as far as one can be had by telling the C
// library to use nothing that not every x86-64 processor has (glibc's tunables; without glibc both runs are
// alike). docs/decisions/0002.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

const std::string kSamples = FAULTLINE_SOURCE_DIR "/sample_logs/";

/// By file name, with what the program wrote to its standard output.
using Files = std::map<std::string, std::string>;

/// Runs the program in a folder of its own ("@name" in `arguments` is a file there): on this processor, or on
/// the plainest.
Files files_of(std::vector<std::string> arguments, bool plainest) {
  const TemporaryFolder folder;
  for (std::string& argument : arguments)
    if (argument.starts_with("@")) argument = folder.file(argument.substr(1));
  RunOptions options;
  if (plainest) options.environment = {"GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX2,-AVX,-FMA,-FMA4"};
  const ProgramRun run = run_program(arguments, options);
  EXPECT_LE(run.status, 1) << run.err;
  Files files;
  // Its own folder is the only thing in which two runs may differ.
  std::string said = run.out;
  const std::string own = folder.path().string();
  for (std::size_t at = 0; (at = said.find(own)) != std::string::npos;)
    said.replace(at, own.size(), "FOLDER");
  files["standard output"] = said;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().extension() != ".db") files[entry.path().filename()] = read_file(entry.path().string());
  return files;
}

void expect_same_bytes(const std::vector<std::string>& arguments, std::size_t files) {
  const Files here = files_of(arguments, false), there = files_of(arguments, true);
  EXPECT_EQ(here.size(), files);
  ASSERT_EQ(here.size(), there.size());
  for (const auto& [name, bytes] : here)
    EXPECT_TRUE(bytes == there.at(name)) << name << " of " << arguments[0] << " " << arguments[1];
}

/// The first file of that folder whose name begins so.
std::string file_in(const std::string& folder, const std::string& beginning) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(beginning)) return entry.path().string();
  return "";
}

TEST(SameBytes, DiagnosesHaveTheSameBytesOnAnyProcessor) {
  const std::string golden = kSamples + "golden", model = file_in(golden, "model-"),
                    cases = file_in(golden, "cases-");
  for (const char* log : {"healthy_2", "collision_1", "friction_increase_1", "payload_change",
                          "sensor_drift_2", "torque_sensor_error_1"})
    expect_same_bytes({"diagnose", kSamples + "bench/" + log + ".csv", "--model", model, "--cases", cases,
                       "--json", "@d.json", "--csv", "@d.csv", "--html", "@d.html"},
                      4);
}

TEST(SameBytes, GoldenChecksHaveTheSameBytesOnAnyProcessor) {
  expect_same_bytes({"golden", "check", kSamples + "golden", "--json", "@check.json"}, 2);
}

/// The twin's motion, identification, residual network, both classifiers, criterion, calibration and cases.
TEST(SameBytes, SimulatedLogsAndLearnedModelsHaveTheSameBytesOnAnyProcessor) {
  const TemporaryFolder folder;
  const std::string spec = folder.write(
      "spec.toml", "robot = \"R\"\nduration_s = 10.0\nsample_period_s = 0.01\n[[run]]\nname = \"healthy\"\n");
  expect_same_bytes({"simulate", spec, "-o", "@"}, 3);
  ASSERT_EQ(run_program({"simulate", spec, "-o", folder.file("")}).status, 0);
  expect_same_bytes({"learn", folder.file("healthy.csv"), "--robot", "R", "--runs-per-label", "4", "--json",
                     "@learned.json", "-o", "@model"},
                    3);
}

}  // namespace
}  // namespace faultline
