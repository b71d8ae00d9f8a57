// SPDX-License-Identifier: MIT
// Who confirmed a case and when, events that are told twice, labels that cannot be, deleting and exporting.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/report/text.hpp"
#include "tests/cases/example_base.hpp"
#include "tests/report/example_diagnosis.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class CaseProvenance : public testing::Test {
 protected:
  CaseProvenance() {
    CaseBase base = example_base(2);
    base.describe_robot({"bench", "RRP"});
    write_case_base(path_, base);
  }

  ProgramRun cases(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "cases");
    arguments.insert(arguments.end(), {"--cases", path_});
    return run_program(arguments, {.environment = {"SOURCE_DATE_EPOCH=1772409600"}});
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("bench.json.cases.db");
  std::string report_ = folder_.write("report.json", render_json(faulty_diagnosis()));
};

TEST_F(CaseProvenance, AddKeepsPersonDateAndRobot) {
  ASSERT_EQ(cases({"add", report_, "--fault", "locked", "--joint", "2", "--by", "A. Weber"}).status, 0);
  const Case c = read_case_base(path_).at(7);
  EXPECT_EQ(c.person, "A. Weber");
  EXPECT_EQ(c.date, "2026-03-02") << "of SOURCE_DATE_EPOCH";
  EXPECT_EQ(c.robot, "bench") << "of the report";
  const ProgramRun list = cases({"list", "--origin", "field"});
  EXPECT_TRUE(has(list.out, "confirmed in the field by A. Weber on 2026-03-02, robot bench")) << list.out;
  EXPECT_TRUE(has(list.out, "1 of 7 cases"));
  EXPECT_TRUE(has(cases({"list", "--origin", "simulated"}).out, "simulated with the robot's model"));
  EXPECT_TRUE(has(cases({"list", "--by", "nobody"}).out, "0 of 7"));
  EXPECT_TRUE(has(cases({"show", "7"}).out, "person   A. Weber"));
  EXPECT_EQ(nlohmann::json::parse(cases({"show", "7", "--json"}).out).at("date"), "2026-03-02");
}

TEST_F(CaseProvenance, AnInvalidDateIsRefused) {
  for (const char* date : {"2026-02-30", "yesterday", "2026-2-3", "02.03.2026"})
    EXPECT_EQ(cases({"add", report_, "--date", date}).status, 2) << date;
  ASSERT_EQ(cases({"add", report_, "--date", "2026-02-28", "--robot", "bench 7"}).status, 0);
  EXPECT_EQ(read_case_base(path_).at(7).date, "2026-02-28");
  EXPECT_EQ(read_case_base(path_).at(7).robot, "bench 7");
}

TEST_F(CaseProvenance, AddingTheSameReportTwiceMakesOneCase) {
  ASSERT_EQ(cases({"add", report_}).status, 0);
  const std::string before = read_file(path_);
  const ProgramRun again = cases({"add", report_});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_TRUE(has(again.err, "already case 7") && has(again.err, "nothing was changed")) << again.err;
  EXPECT_EQ(read_file(path_), before);
}

TEST_F(CaseProvenance, ASecondReportOfAnEventUpdatesItsCaseAndIsReported) {
  ASSERT_EQ(cases({"add", report_}).status, 0);
  const ProgramRun told =
      cases({"add", report_, "--fault", "stuck_encoder", "--joint", "2", "--by", "A. Weber"});
  EXPECT_EQ(told.status, 0);
  EXPECT_TRUE(has(told.err, "already case 7") && has(told.err, "now confirmed")) << told.err;
  const CaseBase base = read_case_base(path_);
  ASSERT_EQ(base.cases().size(), 7u);
  EXPECT_EQ(base.at(7).label.kind, FaultKind::stuck_encoder);
  EXPECT_EQ(base.at(7).person, "A. Weber");
}

TEST_F(CaseProvenance, ConfirmAndRejectStoreThePersonAndTheDate) {
  ASSERT_EQ(cases({"add", report_}).status, 0);
  ASSERT_EQ(cases({"confirm", "7", "--by", "A. Weber", "--date", "2026-02-01"}).status, 0);
  EXPECT_EQ(read_case_base(path_).at(7).date, "2026-02-01");
  ASSERT_EQ(cases({"confirm", "7", "--done", "new brake"}).status, 0);
  EXPECT_EQ(read_case_base(path_).at(7).person, "A. Weber") << "a note alone is no other word";
  EXPECT_EQ(read_case_base(path_).at(7).date, "2026-02-01");
  ASSERT_EQ(cases({"reject", "7"}).status, 0);
  EXPECT_EQ(read_case_base(path_).at(7).person, "") << "it is not she who says so";
  EXPECT_EQ(read_case_base(path_).at(7).date, "2026-03-02");
}

TEST_F(CaseProvenance, LabelsThatTheRobotCannotHaveAreRefused) {
  const std::string before = read_file(path_);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"add", report_, "--fault", "locked", "--joint", "4"},
        {"add", "--fault", "locked", "--joint", "9"},
        {"add", report_, "--fault", "locked"},
        {"confirm", "1", "--fault", "locked", "--joint", "4"},
        {"reject", "1", "--fault", "collision", "--joint", "4"}}) {
    const ProgramRun run = cases(command);
    EXPECT_EQ(run.status, 2) << command[0];
    EXPECT_TRUE(has(run.err, "joint")) << run.err;
  }
  EXPECT_EQ(read_file(path_), before);
}

TEST_F(CaseProvenance, ImportRefusesCasesOfJointsThatTheRobotLacks) {
  CaseBase base = read_case_base(path_);
  base.describe_robot({"old", "RR"});
  const std::string other = folder_.file("other.db"), file = folder_.file("other.json");
  write_case_base(other, base);
  ASSERT_EQ(run_program({"cases", "export", "-o", file, "--cases", other}).status, 0);
  const ProgramRun import = run_program({"cases", "import", file, "--cases", folder_.file("new.db")});
  EXPECT_EQ(import.status, 2);
  EXPECT_TRUE(has(import.err, "joint 3") && has(import.err, "2 joints")) << import.err;
  const ProgramRun merge = cases({"import", file, "--merge"});
  EXPECT_EQ(merge.status, 2) << merge.err;
}

TEST_F(CaseProvenance, MergeOfAnotherKindOfRobotIsRefused) {
  CaseBase base = read_case_base(path_);
  base.describe_robot({"gantry", "PPR"});
  const std::string other = folder_.file("other.db"), file = folder_.file("other.json");
  write_case_base(other, base);
  ASSERT_EQ(run_program({"cases", "export", "-o", file, "--cases", other}).status, 0);
  const ProgramRun merge = cases({"import", file, "--merge"});
  EXPECT_EQ(merge.status, 2);
  EXPECT_TRUE(has(merge.err, "PPR") && has(merge.err, "RRP")) << merge.err;
}

TEST_F(CaseProvenance, ExportCanSelectConfirmedCasesAndMergeAddsThemOnce) {
  ASSERT_EQ(cases({"add", report_, "--fault", "locked", "--joint", "2", "--by", "A. Weber"}).status, 0);
  const std::string file = folder_.file("confirmed.json"), other = folder_.file("other.db");
  ASSERT_EQ(cases({"export", "--confirmed", "-o", file}).status, 0);
  EXPECT_EQ(nlohmann::json::parse(read_file(file)).at("cases").size(), 1u);
  CaseBase base = example_base(2);
  base.describe_robot({"bench 8", "RRP"});
  write_case_base(other, base);
  const std::vector<std::string> merge = {"cases", "import", file, "--merge", "--json", "--cases", other};
  EXPECT_EQ(nlohmann::json::parse(run_program(merge).out).at("added"), 1);
  const std::string before = read_file(other);
  EXPECT_EQ(nlohmann::json::parse(run_program(merge).out).at("added"), 0);
  EXPECT_EQ(read_file(other), before);
  EXPECT_EQ(read_case_base(other).at(7).robot, "bench");
}

TEST_F(CaseProvenance, DeleteRemovesOneCase) {
  ASSERT_EQ(cases({"add", report_}).status, 0);
  const ProgramRun run = cases({"delete", "7"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.out, "deleted") && has(run.out, "locked_2.csv")) << run.out;
  EXPECT_EQ(cases({"delete", "7"}).status, 2);
  EXPECT_TRUE(has(cases({"delete", "2"}).err, "learn")) << "a learned one comes back";
  const CaseBase base = read_case_base(path_);
  EXPECT_EQ(base.cases().size(), 5u);
  EXPECT_THROW(base.at(2), std::exception);
}

}  // namespace
}  // namespace faultline
