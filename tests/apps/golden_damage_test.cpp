// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/apps/golden_copy.hpp"

namespace faultline {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(GoldenDamage, AMissingLogIsNamedAndTheRestIsChecked) {
  const GoldenCopy golden;
  std::filesystem::remove(golden.file("logs", "locked_1"));
  const ProgramRun run = golden.run("check");
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_TRUE(has(run.out, "logs/locked_1.csv")) << run.out;
  EXPECT_TRUE(has(run.out, "8 of 9 as expected") || has(run.out, "7 of 9 as expected"));
  EXPECT_TRUE(has(run.out, "1 damaged."));
}

TEST(GoldenDamage, AChangedModelOrCaseBaseIsRefused) {
  for (const char* file : {"model-", "cases-"}) {
    const GoldenCopy golden;
    const std::string path = golden.file("", file);
    write_file(path, read_file(path).substr(0, 3000));
    const ProgramRun run = golden.run("check");
    EXPECT_EQ(run.status, 3) << file << run.out;
    EXPECT_TRUE(has(run.err, file)) << run.err;
  }
}

TEST(GoldenDamage, AFolderWithoutGoldenTomlIsRefusedWithTheCommandThatMakesOne) {
  const TemporaryFolder folder;
  const ProgramRun run = run_program({"golden", "check", folder.path().string()});
  EXPECT_EQ(run.status, 3);
  EXPECT_TRUE(has(run.err, "faultline golden record")) << run.err;
}

TEST(GoldenDamage, AMisspeltToleranceIsRefusedWithItsLine) {
  const GoldenCopy golden;
  golden.edit("velocity_rms = {", "velocity_rsm = {");
  const ProgramRun run = golden.run("check");
  EXPECT_EQ(run.status, 3);
  EXPECT_TRUE(has(run.err, "did you mean \"velocity_rms\"?")) << run.err;
  EXPECT_TRUE(has(run.err, "line "));
}

TEST(GoldenDamage, AFileOutsideTheFolderIsRefused) {
  const GoldenCopy golden;
  golden.edit("logs/locked_1.csv", "../locked_1.csv");
  EXPECT_EQ(golden.run("check").status, 3);
}

}  // namespace
}  // namespace faultline
