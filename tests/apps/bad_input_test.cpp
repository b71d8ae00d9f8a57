// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

/// Logs that users really have, given to the built program.
class BadInput : public testing::Test {
 protected:
  ProgramRun inspect(const std::string& text) {
    return run_program({"inspect", folder_.write("log.csv", text)});
  }
  ProgramRun convert(const std::string& text, const RunOptions& options = {}) {
    return run_program({"convert", folder_.write("log.csv", text), folder_.file("out.csv")}, options);
  }
  /// Names of all files in the folder, sorted.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

  TemporaryFolder folder_;
};

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

void expect_one_sentence(const ProgramRun& run, int status, const std::vector<std::string>& words) {
  EXPECT_EQ(run.status, status) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  expect_words(run.err, words);
}

const std::string kGood = "t,q1,dq1,tau1\n0,0,1,2\n0.1,0.1,1,2.5\n0.2,0.2,1,3\n0.3,0.3,1,2\n";

TEST_F(BadInput, InspectRefusesAMissingFile) {
  expect_one_sentence(run_program({"inspect", folder_.file("none.csv")}), 3, {"none.csv", "no such file"});
}

TEST_F(BadInput, InspectRefusesAFolder) {
  expect_one_sentence(run_program({"inspect", folder_.path().string()}), 3, {"is a directory"});
}

TEST_F(BadInput, InspectRefusesAnEmptyFile) { expect_one_sentence(inspect(""), 3, {"log.csv", "is empty"}); }

TEST_F(BadInput, InspectRefusesAFileWithoutDataRows) {
  expect_one_sentence(inspect("t,q1,tau1\n"), 3, {"no data row"});
}

TEST_F(BadInput, InspectRefusesABinaryFile) {
  expect_one_sentence(inspect(std::string("\x7f\x45\x4c\x46\0\0\0", 7)), 3, {"unknown format", "CSV"});
}

TEST_F(BadInput, ALogOfOneRowIsReadAndHasNoSamplePeriod) {
  const ProgramRun run = inspect("t,q1,dq1,tau1\n0.5,1,2,3\n");
  EXPECT_EQ(run.status, 0) << run.err;
  expect_words(run.out, {"1 rows", "1 joint"});
  EXPECT_EQ(run.out.find("sample period"), std::string::npos);
}

TEST_F(BadInput, InspectReportsTextInPlaceOfANumberAsAMissingValue) {
  const ProgramRun run = inspect(kGood + "0.4,oops,1,2\n");
  EXPECT_EQ(run.status, 0);
  expect_words(run.out, {"not_a_number q1", "row 5 (line 6)", "\"oops\"", "treated as missing"});
}

TEST_F(BadInput, InspectReportsRowsThatAreTooShortOrTooLong) {
  const ProgramRun run = inspect(kGood + "0.4,1\n0.5,1,2,3\n0.6,1,2,3,4,5\n0.7,1,2,3\n");
  EXPECT_EQ(run.status, 1) << "one row of eight is lost, which is severe";
  expect_words(run.out,
               {"ragged_row", "row 5 (line 6)", "row_too_long", "8 rows (7 used)", "many_rows_dropped"});
}

TEST_F(BadInput, InspectReportsNanAndInfiniteValues) {
  const ProgramRun run = inspect(kGood + "0.4,nan,inf,2\n");
  expect_words(run.out, {"missing_values q1", "value_implausible dq1", "1 missing"});
}

TEST_F(BadInput, AMissingPositionIsReportedWithTheKeyThatMapsIt) {
  const ProgramRun run = inspect("t,alpha\n0,1\n1,2\n");
  EXPECT_EQ(run.status, 1);
  expect_words(run.out, {"no_joint_log", "\"alpha\"", "[log.columns] q1 = {name"});
  expect_one_sentence(convert("t,alpha\n0,1\n1,2\n"), 3, {"position of joint 1", "[log.columns] q1 = {name"});
  EXPECT_EQ(files(), (std::vector<std::string>{"log.csv"}));
}

TEST_F(BadInput, InspectRefusesTwoColumnsOfOneName) {
  expect_one_sentence(inspect("t,q1,q1\n0,1,2\n"), 3, {"two columns named \"q1\""});
}

TEST_F(BadInput, InspectReportsRepeatedAndBackwardTimes) {
  const ProgramRun run = inspect(kGood + "0.3,1,2,3\n0.1,1,2,3\n0.4,0.4,1,2\n");
  EXPECT_EQ(run.status, 1);
  expect_words(run.out,
               {"time_repeated t", "first in row 5", "time_backward t", "first in row 6", "7 rows (5 used)"});
}

TEST_F(BadInput, InspectReportsALogOfAnotherRobot) {
  const std::string robot = folder_.write("robot.toml", "axes = \"RRP\"\n");
  const ProgramRun run = run_program({"inspect", folder_.write("log.csv", kGood), "--robot", robot});
  EXPECT_EQ(run.status, 1);
  expect_words(run.out, {"other_robot", "1 joints", "3 axes"});
}

TEST_F(BadInput, AMissingRobotFileIsNamed) {
  const ProgramRun run =
      run_program({"inspect", folder_.write("log.csv", kGood), "--robot", folder_.file("no.toml")});
  EXPECT_GE(run.status, 2);
  EXPECT_LE(run.status, 3);
  expect_words(run.err, {"no.toml"});
}

TEST_F(BadInput, OneUnreadableLogDoesNotHideTheOthers) {
  const ProgramRun run = run_program({"inspect", folder_.file("none.csv"), folder_.write("log.csv", kGood)});
  EXPECT_EQ(run.status, 3);
  expect_words(run.err, {"none.csv"});
  expect_words(run.out, {"log.csv", "4 rows"});
}

TEST_F(BadInput, FullDiskLeavesNothingUnderTheFinalName) {
  std::string rows = "t,q1,dq1,tau1\n";
  for (int i = 0; i < 5000; ++i)
    rows += std::to_string(0.01 * i) + "," + std::to_string(std::sin(0.01 * i)) + "," +
            std::to_string(std::cos(0.01 * i)) + ",3\n";
  for (const char* out : {"out.csv", "out.flog", "out.h5", "out.mcap", "out.npz", "out.mat"}) {
    const std::string log = folder_.write("log.csv", rows);
    const ProgramRun run = run_program({"convert", log, folder_.file(out)}, {.file_size_limit = 4096});
    expect_one_sentence(run, 3, {out, "cannot be written", "File too large"});
    EXPECT_EQ(files(), (std::vector<std::string>{"log.csv"}));
  }
}

TEST_F(BadInput, AFullStandardOutputIsAFileError) {
  const std::string log = folder_.write("log.csv", kGood);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"convert", log, "-"}, {"inspect", log}, {"inspect", log, "--json", "-"}}) {
    const ProgramRun run = run_program(command, {.stdout_path = "/dev/full"});
    EXPECT_EQ(run.status, 3);
    expect_words(run.err, {"standard output", "No space left"});
  }
}

TEST_F(BadInput, AMissingOutputFolderIsAFileError) {
  const ProgramRun run =
      run_program({"convert", folder_.write("log.csv", kGood), folder_.file("no/out.csv")});
  expect_one_sentence(run, 3, {"out.csv", "cannot be created"});
}

TEST_F(BadInput, AnUnknownOutputFormatIsAUsageError) {
  const ProgramRun run = run_program({"convert", folder_.write("log.csv", kGood), folder_.file("out.xlsx")});
  expect_one_sentence(run, 2, {"out.xlsx", ".flog"});
}

TEST_F(BadInput, ConvertRefusesToOverwriteItsLog) {
  const std::string log = folder_.write("log.csv", kGood);
  expect_one_sentence(run_program({"convert", log, log}), 2, {"OUT", "would overwrite the log", "log.csv"});
  EXPECT_EQ(read_file(log), kGood);
}

TEST_F(BadInput, ACutNativeLogIsReadUpToTheCut) {
  const std::string native = folder_.file("log.flog");
  ASSERT_EQ(run_program({"convert", folder_.write("log.csv", kGood), native}).status, 0);
  const std::string bytes = read_file(native);
  folder_.write("cut.flog", bytes.substr(0, bytes.size() - 10));
  const ProgramRun run = run_program({"inspect", folder_.file("cut.flog")});
  EXPECT_EQ(run.status, 1);
  expect_words(run.out, {"file_truncated", "4 rows"});
}

}  // namespace
}  // namespace faultline
