// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
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

class CasesCommand : public testing::Test {
 protected:
  CasesCommand() {
    CaseBase base = example_base(2);
    base.describe_robot({"bench", "RRP"});
    write_case_base(path_, base);
  }

  ProgramRun cases(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "cases");
    arguments.insert(arguments.end(), {"--cases", path_});
    return run_program(arguments);
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.file("bench.json.cases.db");
};

TEST_F(CasesCommand, ListShowsAllCasesOrThoseThatMatchAFilter) {
  const ProgramRun all = cases({"list"});
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_NE(all.out.find("6 of 6 cases"), std::string::npos) << all.out;
  EXPECT_NE(all.out.find("joint 2 is locked"), std::string::npos);
  EXPECT_NE(cases({"list", "--fault", "locked"}).out.find("2 of 6"), std::string::npos);
  EXPECT_NE(cases({"list", "--outcome", "rejected"}).out.find("0 of 6"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(cases({"list", "--json"}).out).size(), 6u);
}

TEST_F(CasesCommand, TheModelOptionSelectsTheCaseBaseBesideTheModel) {
  const ProgramRun run = run_program({"cases", "list", "--model", folder_.file("bench.json")});
  EXPECT_EQ(run.status, 0) << run.err;
}

TEST_F(CasesCommand, ShowPrintsOneCase) {
  EXPECT_NE(cases({"show", "2"}).out.find("Case 2: joint 2 is locked (confirmed)"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(cases({"show", "2", "--json"}).out).at("id"), 2);
}

TEST_F(CasesCommand, ConfirmAndRejectAreStored) {
  EXPECT_EQ(cases({"confirm", "1", "--done", "new coupling"}).status, 0);
  EXPECT_EQ(cases({"reject", "2", "--fault", "stuck_encoder", "--joint", "2"}).status, 0);
  const CaseBase base = read_case_base(path_);
  EXPECT_EQ(base.at(1).what_was_done, "new coupling");
  EXPECT_EQ(base.at(2).outcome, CaseOutcome::rejected);
  EXPECT_EQ(base.at(2).label, (FaultLabel{FaultKind::stuck_encoder, 2_joint}));
}

TEST_F(CasesCommand, AddTakesAFaultFromADiagnosis) {
  Diagnosis diagnosis = faulty_diagnosis();
  const std::string report = folder_.write("report.json", render_json(diagnosis));
  diagnosis.log.sha256 = std::string(64, 'e');
  const std::string other = folder_.write("other.json", render_json(diagnosis));
  const ProgramRun run = cases({"add", report, "--done", "changed the brake", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out).at("outcome"), "unconfirmed");
  EXPECT_EQ(cases({"add", other, "--fault-id", "1", "--fault", "stuck_encoder", "--joint", "2"}).status, 0);
  const CaseBase base = read_case_base(path_);
  EXPECT_EQ(base.at(7).origin, "bench/locked_2.csv");
  EXPECT_EQ(base.at(7).episode.features[2], -0.5);
  EXPECT_EQ(base.at(8).outcome, CaseOutcome::confirmed);
  EXPECT_EQ(base.at(8).label.kind, FaultKind::stuck_encoder);
  EXPECT_EQ(base.at(8).decision.kind, FaultKind::locked);
}

TEST_F(CasesCommand, AddRefusesOtherFilesAndFaultsThatTheDiagnosisLacks) {
  const std::string report = folder_.write("report.json", render_json(faulty_diagnosis()));
  const std::string other = folder_.write("other.json", "[1, 2]");
  EXPECT_EQ(cases({"add", report, "--fault-id", "2"}).status, 2);
  EXPECT_EQ(cases({"add", other}).status, 3);
  EXPECT_EQ(cases({"add", folder_.file("missing.json")}).status, 3);
  EXPECT_EQ(cases({"add"}).status, 2);
  EXPECT_EQ(read_case_base(path_).cases().size(), 6u);
}

TEST_F(CasesCommand, AddRefusesADiagnosisOfAnotherModel) {
  const std::string report = folder_.write("report.json", render_json(faulty_diagnosis()));
  write_case_base(path_, CaseBase({"other"}));
  const ProgramRun run = cases({"add", report});
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.err.find("\"other\""), std::string::npos) << run.err;
}

TEST_F(CasesCommand, AnImportOfAnExportGivesTheSameCaseBase) {
  const std::string file = folder_.file("export.json"), copy = folder_.file("copy.db");
  ASSERT_EQ(cases({"export", "-o", file}).status, 0);
  EXPECT_EQ(cases({"export"}).out, read_file(file));
  ASSERT_EQ(run_program({"cases", "import", file, "--cases", copy}).status, 0);
  EXPECT_EQ(read_case_base(copy).sha256(), read_case_base(path_).sha256());
  EXPECT_EQ(run_program({"cases", "import", file, "--cases", copy}).status, 2)
      << "never over a base that is there";
  const ProgramRun merge = run_program({"cases", "import", file, "--cases", copy, "--merge", "--json"});
  EXPECT_EQ(nlohmann::json::parse(merge.out).at("added"), 0);
}

TEST_F(CasesCommand, WrongArgumentsExitWithStatus2AndUnreadableFilesWith3) {
  EXPECT_EQ(cases({"show", "99"}).status, 2);
  EXPECT_EQ(cases({"confirm", "1", "--fault", "rust"}).status, 2);
  EXPECT_EQ(cases({"confirm", "1", "--joint", "2"}).status, 2);
  EXPECT_EQ(run_program({"cases", "list"}).status, 2);
  EXPECT_EQ(run_program({"cases", "list", "--cases", folder_.file("none.db")}).status, 3);
  EXPECT_EQ(run_program({"cases", "list", "--cases", folder_.write("text.db", "hello")}).status, 3);
  EXPECT_EQ(run_program({"cases"}).status, 2);
}

TEST_F(CasesCommand, HelpShowsAnExampleOfEachAction) {
  for (const char* action : {"list", "show", "add", "confirm", "reject", "delete", "export", "import"}) {
    const ProgramRun run = run_program({"cases", action, "--help"});
    EXPECT_EQ(run.status, 0);
    EXPECT_NE(run.out.find(std::string("Example: faultline cases ") + action), std::string::npos) << run.out;
  }
}

TEST_F(CasesCommand, AnImportThatFillsTheDiskLeavesNoFile) {
  const std::string file = folder_.file("export.json"), copy = folder_.file("copy.db");
  ASSERT_EQ(cases({"export", "-o", file}).status, 0);
  const ProgramRun run = run_program({"cases", "import", file, "--cases", copy}, {.file_size_limit = 8192});
  EXPECT_EQ(run.status, 3) << run.out;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    EXPECT_EQ(entry.path().string().rfind(copy, 0), std::string::npos) << entry.path();
}

TEST_F(CasesCommand, AFullDiskChangesNothing) {
  const std::string before = read_file(path_);
  const ProgramRun run =
      run_program({"cases", "confirm", "1", "--done", std::string(100000, 'x'), "--cases", path_},
                  {.file_size_limit = static_cast<long long>(before.size())});
  EXPECT_EQ(run.status, 3) << run.out;
  EXPECT_EQ(read_case_base(path_).at(1).what_was_done, "");
}

}  // namespace
}  // namespace faultline
