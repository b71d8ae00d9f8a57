// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "lib/cases/case_file.hpp"
#include "tests/apps/golden_copy.hpp"

namespace faultline {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The model and logs of sample_logs/golden, to record anew.
class GoldenRecord : public testing::Test {
 protected:
  GoldenRecord() {
    fs::copy_file(golden_.file("", "model-"), model_);
    fs::copy_file(golden_.file("", "cases-"), case_base_path(model_));
  }

  std::string log(const std::string& name) const { return golden_.path() + "/logs/" + name; }
  ProgramRun record(const std::string& to, std::vector<std::string> more) const {
    more.insert(more.begin(), {"golden", "record", "--model", model_, "-o", to});
    return run_program(more);
  }

  GoldenCopy golden_;
  std::string model_ = golden_.outside("bench");
  std::string made_ = golden_.outside("made");
};

TEST_F(GoldenRecord, RecordedLogsPassTheCheckAlsoAfterTheFolderMoved) {
  std::vector<std::string> logs;
  for (const auto& entry : fs::directory_iterator(golden_.path() + "/logs")) logs.push_back(entry.path());
  std::sort(logs.begin(), logs.end());
  const ProgramRun run = record(made_, logs);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.out, "locked_1.csv: faulty, 1 event")) << run.out;
  EXPECT_TRUE(has(run.out, "Recorded 7 logs"));
  EXPECT_EQ(run_program({"golden", "check", made_}).status, 0);
  for (const auto& entry : fs::directory_iterator(golden_.path() + "/logs"))
    EXPECT_EQ(read_file(made_ + "/logs/" + entry.path().filename().string()), read_file(entry.path()));
  fs::rename(made_, golden_.outside("moved"));  // it stands alone, wherever it is
  fs::remove(model_);
  EXPECT_EQ(run_program({"golden", "check", golden_.outside("moved")}).status, 0);
}

TEST_F(GoldenRecord, KeepsALogOfTheFolderInItsPlace) {
  fs::create_directories(made_ + "/runs");
  fs::copy_file(log("locked_1.csv"), made_ + "/runs/locked_1.csv");
  ASSERT_EQ(record(made_, {made_ + "/runs/locked_1.csv"}).status, 0);
  EXPECT_FALSE(fs::exists(made_ + "/logs"));
  EXPECT_TRUE(has(read_file(made_ + "/golden.toml"), "file = \"runs/locked_1.csv\""));
  EXPECT_EQ(run_program({"golden", "check", made_}).status, 0);
}

TEST_F(GoldenRecord, ReportsWhyNoRobotIsIdentified) {
  EXPECT_TRUE(
      has(record(made_, {log("locked_1.csv")}).out, "identification: none, no log was found healthy"));
  const ProgramRun run =
      record(golden_.outside("other"), {log("healthy_quintic.csv"), "--no-identification"});
  EXPECT_TRUE(has(run.out, "identification: none, not requested")) << run.out;
  EXPECT_FALSE(has(read_file(golden_.outside("other") + "/golden.toml"), "[identification]"));
}

TEST_F(GoldenRecord, RefusesALogWhoseValuesAreInAnotherFile) {
  const std::string trace = golden_.outside("trace.dat"), data = golden_.outside("trace.r64");
  write_file(trace,
             "DIAEXTENDED\n#BEGINCHANNELHEADER\n200,q1\n210,EXPLIZIT\n211,trace.r64\n213,BLOCK\n"
             "214,REAL64\n220,2\n221,1\n#ENDCHANNELHEADER\n");
  write_file(data, "0123456789abcdef");
  const ProgramRun run = record(made_, {trace});
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(has(run.err, "a golden folder keeps one file a log")) << run.err;
  EXPECT_FALSE(fs::exists(made_));
}

TEST_F(GoldenRecord, RefusesAGoldenFolderAndTwoLogsOfOneName) {
  const auto before = golden_.snapshot();
  EXPECT_EQ(record(golden_.path(), {log("locked_1.csv")}).status, 2);
  EXPECT_EQ(golden_.snapshot(), before);
  fs::copy_file(log("locked_1.csv"), golden_.outside("locked_1.csv"));
  const ProgramRun run = record(made_, {log("locked_1.csv"), golden_.outside("locked_1.csv")});
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(has(run.err, "rename one")) << run.err;
}

TEST_F(GoldenRecord, ALogThatCannotBeProcessedLeavesNoGoldenFolder) {
  write_file(golden_.outside("bad.csv"), "t,q1,q2\n0,1,2\n");
  const ProgramRun run = record(made_, {log("locked_1.csv"), golden_.outside("bad.csv")});
  EXPECT_EQ(run.status, 3);
  EXPECT_TRUE(has(run.err, "bad.csv")) << run.err;
  EXPECT_FALSE(fs::exists(made_ + "/golden.toml"));
}

TEST_F(GoldenRecord, MarkupInNamesIsEscapedAndUnprintableNamesAreRefused) {
  const std::string name = "a \"b\" <x> \xE2\x80\xAE & 'c'.csv";
  fs::copy_file(log("locked_1.csv"), golden_.outside(name));
  ASSERT_EQ(record(made_, {golden_.outside(name)}).status, 0);
  const ProgramRun run = run_program({"golden", "check", made_, "--junit", golden_.outside("j.xml")});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_FALSE(has(read_file(golden_.outside("j.xml")), "<x>"));
  for (const char* other : {"\xFF.csv", "two\nlines.csv"}) {
    fs::copy_file(log("locked_1.csv"), golden_.outside(other));
    const ProgramRun refused = record(golden_.outside("other"), {golden_.outside(other)});
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(has(refused.err, "rename the log")) << refused.err;
  }
}

TEST_F(GoldenRecord, TablesOfLabelsAmongTheLogsAreSkipped) {
  const std::string labels = golden_.outside("labels.csv");
  write_file(labels, "file,fault,joint,onset_s\nlocked_1.csv,locked,1,8.44\n");
  const ProgramRun run = record(made_, {golden_.path() + "/logs/locked_1.csv", labels});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.out, "labels.csv is a table of labels, not a log; it is skipped")) << run.out;
  EXPECT_EQ(record(golden_.outside("none"), {labels}).status, 2);
}

}  // namespace
}  // namespace faultline
