// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "lib/cases/case_file.hpp"
#include "lib/core/hash.hpp"
#include "tests/apps/golden_copy.hpp"

namespace faultline {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The text of a model whose alarms need more.
std::string with_higher_threshold(std::string model) {
  const std::string key = "\"threshold\": ";
  const std::size_t at = model.find(key);
  if (at == std::string::npos) throw std::logic_error("the model has no threshold");
  return model.insert(at + key.size(), "2");
}

/// Two logs and the identification of it are not as expected.
class GoldenAccept : public testing::Test {
 protected:
  GoldenAccept() {
    golden_.edit("kind = \"locked\"", "kind = \"collision\"");
    golden_.edit("  {kind = \"payload_change\"", "  {kind = \"unknown\"");  // the event, not an opinion
    golden_.edit("{name = \"b\", value = 0.49", "{name = \"b\", value = 0.48");
  }

  GoldenCopy golden_;
};

TEST_F(GoldenAccept, WithoutNamesAcceptShowsTheDifferencesAndChangesNothing) {
  const auto before = golden_.snapshot();
  const ProgramRun run = golden_.run("accept");
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(has(run.out, "+ event locked joint 1")) << run.out;
  EXPECT_TRUE(has(run.out, "Nothing was changed"));
  EXPECT_EQ(golden_.snapshot(), before);
}

/// As an accept leaves them that was killed before its last step.
TEST_F(GoldenAccept, RemovesOnlyTheFilesThatAnInterruptedAcceptLeft) {
  const std::string trace = "time_s,q1\n0,1\n", traces = golden_.path() + "/traces/";
  const std::string left = traces + "locked_1-" + sha256_hex(trace).substr(0, 8) + ".csv";
  write_file(left, trace);
  write_file(traces + "notes-01234567.csv", "mine");
  EXPECT_EQ(golden_.run("accept", {"--all"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_EQ(read_file(traces + "notes-01234567.csv"), "mine");
  write_file(left, trace);
  EXPECT_TRUE(has(golden_.run("accept", {"--all"}).out, "There is nothing to accept."));
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_EQ(golden_.run("check").status, 0);
}

TEST_F(GoldenAccept, UpdatesOnlyTheNamedItems) {
  const ProgramRun run = golden_.run("accept", {"locked_1"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.out, "+ event locked joint 1")) << run.out;
  EXPECT_TRUE(has(run.out, "Accepted: locked_1.csv\n"));
  EXPECT_FALSE(has(run.out, "payload_change.csv"));
  const ProgramRun check = golden_.run("check");
  EXPECT_EQ(check.status, 1);
  EXPECT_TRUE(has(check.out, "7 of 9 as expected, 2 different")) << check.out;
  EXPECT_EQ(golden_.run("accept", {"identification", "payload_change.csv"}).status, 0);
  EXPECT_EQ(golden_.run("check").status, 0);
}

TEST_F(GoldenAccept, AllAcceptsEveryDifference) {
  EXPECT_EQ(golden_.run("accept", {"--all"}).status, 0);
  const ProgramRun check = golden_.run("check");
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_TRUE(has(golden_.run("accept", {"--all"}).out, "There is nothing to accept."));
}

TEST_F(GoldenAccept, KeepsEditedTolerances) {
  golden_.edit("onset_s = {absolute = 0.15", "onset_s = {absolute = 0.25");
  EXPECT_EQ(golden_.run("accept", {"--all"}).status, 0);
  EXPECT_TRUE(has(read_file(golden_.toml()), "onset_s = {absolute = 0.25, relative = 0}"));
}

TEST_F(GoldenAccept, AnInterruptedAcceptLeavesGoldenTomlUnchanged) {
  const std::string before = read_file(golden_.toml());
  RunOptions options;
  options.file_size_limit = 4096;  // less than golden.toml: writing fails halfway
  const ProgramRun run = run_program({"golden", "accept", golden_.path(), "--all"}, options);
  EXPECT_EQ(run.status, 3) << run.out;
  EXPECT_EQ(read_file(golden_.toml()), before);
  EXPECT_EQ(golden_.run("check").status, 1) << "damage would be 3";
}

TEST_F(GoldenAccept, ReplacesALogThatWasChangedOnPurpose) {
  const std::string log = golden_.file("logs", "locked_1");
  const std::string text = read_file(log);
  write_file(log, text.substr(0, text.rfind('\n', text.size() - 2) + 1));  // a row less
  EXPECT_EQ(golden_.run("check").status, 3);
  EXPECT_EQ(golden_.run("accept", {"--all"}).status, 0);
  EXPECT_EQ(golden_.run("check").status, 0);
}

TEST_F(GoldenAccept, RefusesAnUnknownNameAndListsTheKnownOnes) {
  const ProgramRun run = golden_.run("accept", {"locked_7"});
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(has(run.err, "collision_1.csv")) << run.err;
}

TEST_F(GoldenAccept, AllWithANewModelReplacesTheOldModel) {
  const std::string model = golden_.outside("new.model");
  std::string text = read_file(golden_.file("", "model-"));
  const std::string old_name = std::filesystem::path(golden_.file("", "model-")).filename();
  write_file(model, text + " ");
  std::filesystem::copy_file(golden_.file("", "cases-"), case_base_path(model));
  ASSERT_EQ(run_program({"model", "sign", model}).status, 0);
  EXPECT_EQ(golden_.run("accept", {"--all", "--model", model}).status, 0);
  EXPECT_EQ(golden_.run("check").status, 0);
  EXPECT_TRUE(has(read_file(golden_.toml()), "name = \"new.model\""));
  EXPECT_FALSE(std::filesystem::exists(golden_.path() + "/" + old_name)) << "the old model is not needed";
}

TEST_F(GoldenAccept, OneLogIsAcceptedWithANewModelAndOthersKeepTheirExpectations) {
  const std::string model = golden_.outside("new.model");
  write_file(model, with_higher_threshold(read_file(golden_.file("", "model-"))));
  std::filesystem::copy_file(golden_.file("", "cases-"), case_base_path(model));
  ASSERT_EQ(run_program({"model", "sign", model}).status, 0);
  const ProgramRun run = golden_.run("accept", {"locked_1", "--model", model});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.out, "Accepted, with the new model: locked_1.csv")) << run.out;
  EXPECT_TRUE(has(read_file(golden_.toml()), "name = \"new.model\""));
  EXPECT_FALSE(has(golden_.run("check").out, "threshold is"));
}

TEST_F(GoldenAccept, SameVerdictAcceptsOnlyLogsThatDifferInNumbersAlone) {
  golden_.edit("confidence = 0.", "confidence = 0.0");  // of the first event
  const ProgramRun check = golden_.run("check");
  EXPECT_EQ(check.status, 1);
  EXPECT_TRUE(has(check.out, "4 different (2 also in the findings)")) << check.out;
  const ProgramRun run = golden_.run("accept", {"--same-verdict"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(has(run.out, "differ in: locked_1.csv, payload_change.csv")) << run.out;
  EXPECT_TRUE(has(run.out, "Accepted: collision_1.csv, ")) << run.out;
  EXPECT_TRUE(has(golden_.run("check").out, "2 different (2 also in the findings)"));
  const std::string model = golden_.outside("new.model");
  write_file(model, read_file(golden_.file("", "model-")));
  std::filesystem::copy_file(golden_.file("", "cases-"), case_base_path(model));
  const std::string before = read_file(golden_.toml());
  EXPECT_EQ(golden_.run("accept", {"--same-verdict", "--model", model}).status, 1);
  EXPECT_EQ(read_file(golden_.toml()), before) << "a model that finds something else is not taken";
}

TEST(GoldenOfAnEarlierSchema, IsRefusedWithTheAdviceToRecordItAgain) {
  const GoldenCopy golden;
  write_file(golden.toml(), std::regex_replace(read_file(golden.toml()), std::regex("golden/2"), "golden/1"));
  const ProgramRun check = golden.run("check");
  EXPECT_EQ(check.status, 3) << check.out << check.err;
  EXPECT_TRUE(has(check.err, "record the folder again")) << check.err;
}

}  // namespace
}  // namespace faultline
