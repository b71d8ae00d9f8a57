// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "lib/cases/case_file.hpp"
#include "lib/core/hash.hpp"
#include "tests/apps/golden_copy.hpp"

namespace faultline {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The project's own guard: what it says of the committed logs stays as it was accepted.
TEST(GoldenCheck, TheProjectsOwnGoldenLogsAreAsExpected) {
  const ProgramRun run = run_program({"golden", "check", FAULTLINE_SOURCE_DIR "/sample_logs/golden"});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_TRUE(has(run.out, "9 of 9 as expected"));
}

TEST(GoldenCheck, WritesNothingIntoTheFolder) {
  const GoldenCopy golden;
  golden.edit("kind = \"locked\"", "kind = \"collision\"");
  const auto before = golden.snapshot();
  EXPECT_EQ(golden.run("check").status, 1);
  EXPECT_EQ(golden.run("accept").status, 1);
  EXPECT_EQ(golden.snapshot(), before);
}

TEST(GoldenCheck, WorksOnAReadOnlyFolder) {
  const GoldenCopy golden;
  namespace fs = std::filesystem;
  fs::permissions(golden.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_EQ(golden.run("check").status, 0);
  fs::permissions(golden.path(), fs::perms::owner_all);
}

TEST(GoldenCheck, NamesAMissingAndAnUnexpectedEvent) {
  const GoldenCopy golden;
  golden.edit("kind = \"locked\"", "kind = \"collision\"");
  const ProgramRun run = golden.run("check");
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(has(run.out, "- event collision joint 1: onset 6.")) << run.out;
  EXPECT_TRUE(has(run.out, "+ event locked joint 1: onset 6."));
  EXPECT_TRUE(has(run.out, "8 of 9 as expected, 1 different (1 also in the findings), 0 damaged."));
}

/// Puts `value` for dq2 at 3.212 s into the expected trace of locked_1, and names the new trace in
/// golden.toml.
void expect_another_dq2(const GoldenCopy& golden, const std::string& value) {
  const std::string trace = golden.file("traces", "locked_1");
  std::string rows = read_file(trace);
  std::size_t field = rows.find("\n3.212,");
  for (int comma = 0; comma < 5; ++comma) field = rows.find(',', field + 1);
  rows.replace(field + 1, rows.find(',', field + 1) - field - 1, value);
  const std::string before = sha256_of_file(trace);
  write_file(trace, rows);
  golden.edit(before, sha256_hex(rows));
}

TEST(GoldenCheck, NamesChannelTimeValueAndExpectationOfTheFirstDivergence) {
  const GoldenCopy golden;
  expect_another_dq2(golden, "0.25");
  const ProgramRun run = golden.run("check", {"--json", golden.outside("check.json")});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(has(run.out, "first divergence at 3.212 s: dq2 is 1.2168")) << run.out;
  EXPECT_TRUE(has(run.out, "expected 0.25 (allowed +-"));
  const auto json = nlohmann::json::parse(read_file(golden.outside("check.json")));
  EXPECT_EQ(json.at("result"), "different");
  const auto& first = json.at("items").at(3).at("first_divergence");
  EXPECT_EQ(first.at("channel"), "dq2");
  EXPECT_EQ(first.at("time_s"), 3.212);
  EXPECT_EQ(first.at("expected"), "0.25");
}

TEST(GoldenCheck, ATolerancePerLogAndChannelAllowsADeviation) {
  const GoldenCopy golden;
  expect_another_dq2(golden, "0.25");
  std::string text = read_file(golden.toml());
  const std::size_t next_log = text.find("\n[[log]]", text.find("logs/locked_1.csv"));
  write_file(golden.toml(), text.insert(next_log, "\n[log.tolerance]\ndq2 = {absolute = 1.0}\n"));
  const ProgramRun run = golden.run("check");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
}

TEST(GoldenCheck, FindsAChangeOfAnIdentifiedParameter) {
  const GoldenCopy golden;
  golden.edit("{name = \"b\", value = 0.49", "{name = \"b\", value = 0.48");
  const ProgramRun run = golden.run("check");
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(has(run.out, "- b 0.48")) << run.out;
  EXPECT_TRUE(has(run.out, "+ b 0.49"));
  EXPECT_TRUE(has(run.out, "first divergence: b is 0.49"));
}

TEST(GoldenCheck, JUnitHasACaseForEachLogAndTheDifferenceInItsFailure) {
  const GoldenCopy golden;
  golden.edit("kind = \"locked\"", "kind = \"collision\"");
  write_file(golden.file("logs", "payload"), "t,q1\n");
  const ProgramRun run = golden.run("check", {"--junit", "-"});
  EXPECT_EQ(run.status, 3) << run.err;
  EXPECT_TRUE(has(run.out, "<testsuite name=\"golden\" tests=\"9\" failures=\"1\" errors=\"1\">")) << run.out;
  EXPECT_TRUE(has(run.out, "<failure type=\"verdict\" message=\"first divergence at 6."));
  EXPECT_TRUE(has(run.out, "+ event locked joint 1"));
  EXPECT_TRUE(has(run.out, "<error type=\"damaged\" message=\"logs/payload_change.csv is not the file"));
}

TEST(GoldenCheck, AnotherModelIsComparedWithTheExpectations) {
  const GoldenCopy golden;
  std::string model = read_file(golden.file("", "model-"));
  const std::string rms = "\"velocity_rms\"";
  ASSERT_NE(model.find(rms), std::string::npos);
  const std::size_t number = model.find_first_of("0123456789", model.find(rms) + rms.size());
  model.insert(number, "1");
  write_file(golden.outside("other.model"), model);
  std::filesystem::copy_file(golden.file("", "cases-"), case_base_path(golden.outside("other.model")));
  ASSERT_EQ(run_program({"model", "sign", golden.outside("other.model")}).status, 0);
  const ProgramRun run = golden.run("check", {"--model", golden.outside("other.model")});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(has(run.out, "model other.model")) << run.out;
  const ProgramRun compared =
      golden.run("compare", {golden.outside("other.model"), "--json", golden.outside("compared.json")});
  EXPECT_EQ(compared.status, 1) << compared.err;
  EXPECT_EQ(nlohmann::json::parse(read_file(golden.outside("compared.json"))).at("result"), "different");
  EXPECT_EQ(golden.run("compare", {golden.outside("other.model"), golden.outside("other.model")}).status, 0);
}

TEST(GoldenCheck, FindsAnInertiaThatDiffersByHalfAPercent) {
  const GoldenCopy golden;
  const std::string other = golden.outside("other.model");
  auto model = nlohmann::ordered_json::parse(read_file(golden.file("", "model-")));
  std::string robot = model["robot"];
  const std::string key = "inertia = [0.0, ";
  std::size_t begin = robot.find(key);
  ASSERT_NE(begin, std::string::npos) << robot;
  begin += key.size();
  for (int axis = 0; axis < 2; ++axis) {
    const std::string more = std::to_string(1.005 * std::stod(robot.substr(begin)));
    robot.replace(begin, robot.find(',', begin) - begin, more);
    begin += more.size() + 2;
  }
  model["robot"] = robot;
  write_file(other, model.dump(1) + "\n");
  std::filesystem::copy_file(golden.file("", "cases-"), case_base_path(other));
  ASSERT_EQ(run_program({"model", "sign", other}).status, 0);
  const ProgramRun run = golden.run("check", {"--model", other});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(has(run.out, "model_")) << run.out;
}

TEST(GoldenCheck, ARunOfAnotherProgramVersionIsComparedByItsJson) {
  const GoldenCopy golden;
  const std::string result = golden.outside("old.json");
  ASSERT_EQ(golden.run("check", {"--json", result}).status, 0);
  EXPECT_EQ(golden.run("compare", {result}).status, 0);
  auto old = nlohmann::ordered_json::parse(read_file(result));
  old["program"]["version"] = "0.0.9";
  old["logs"][3]["events"][0]["onset_s"] = 1.0;
  old["logs"][3]["trace"]["values"][0][0] = nullptr;
  write_file(result, old.dump(1));
  const ProgramRun run = golden.run("compare", {result});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(has(run.out, "--- locked_1.csv: expected by faultline 0.0.9, model bench")) << run.out;
  EXPECT_TRUE(has(run.out, "first divergence at 0.073 s: q1 is "));
  EXPECT_TRUE(has(run.out, "expected nan"));
  write_file(result, old.dump().substr(0, 5000));
  EXPECT_EQ(golden.run("compare", {result}).status, 3);
}

TEST(GoldenCheck, ThreadsChangeNoByte) {
  const GoldenCopy golden;
  EXPECT_EQ(golden.run("check", {"--threads", "1", "--json", "-"}).out,
            golden.run("check", {"--threads", "3", "--json", "-"}).out);
}

}  // namespace
}  // namespace faultline
