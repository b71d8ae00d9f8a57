// SPDX-License-Identifier: MIT
// The reports that `faultline diagnose` writes, as its user asks for them.
#include <gtest/gtest.h>

#include "formats/log_writer.hpp"
#include "lib/cases/case_file.hpp"
#include "lib/core/atomic_file.hpp"
#include "lib/report/html/html_report.hpp"
#include "tests/learn/small_robot.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

constexpr double kLong_s = 2000.0;  // of a log that takes longer than the .3 s before a bar is shown

/// A folder with a model, its case base and a log of a fault.
class DiagnoseReports : public ::testing::Test {
 protected:
  DiagnoseReports() {
    const Learned learned = learn_small();
    model_ = folder_.write("slide.json", model_to_json(learned.model));
    write_case_base(case_base_path(model_), learned.cases);
    SimulationSpec spec = small_run(7.0);
    spec.faults = {{FaultKind::locked, 1_joint, 3.004, std::numeric_limits<double>::infinity(), 0.0, 0.0}};
    log_ = folder_.file("run.csv");
    write_log(log_, simulate(small_robot(), spec, 31).log);
  }

  ProgramRun diagnose(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"diagnose", log_, "--model", model_});
    return run_program(arguments);
  }

  TemporaryFolder folder_;
  std::string model_, log_;
};

TEST_F(DiagnoseReports, PageAndMarkdownAreWrittenAndAreTheSameEachTime) {
  const std::string first = folder_.file("a.html"), second = folder_.file("b.html");
  const ProgramRun run = diagnose({"--html", first, "--md", "-"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(run.out.rfind("## 1 fault: joint 1 is locked", 0), 0u) << run.out;
  EXPECT_EQ(diagnose({"--html", second}).status, 1);
  const std::string page = read_file(first);
  EXPECT_TRUE(page == read_file(second));
  for (const char* part : {"Identified parameters", "95 % interval", "Logs from which the model was learned",
                           "plot-run-residual", "plot-1-evidence", "plot-1-networks", "id=\"plot-data\""})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find(folder_.path().string()), std::string::npos) << "names a folder of this machine";

  const ProgramRun nowhere = diagnose({"--html", folder_.file("missing/a.html")});
  EXPECT_EQ(nowhere.status, 3);
  EXPECT_NE(nowhere.err.find("missing/a.html"), std::string::npos) << nowhere.err;

  const ProgramRun piped = diagnose({"--html", "-"});
  EXPECT_EQ(piped.out, page);
}

TEST_F(DiagnoseReports, EveryFormatHasItsOption) {
  const std::string help = run_program({"diagnose", "--help"}).out;
  std::vector<std::string> arguments;
  for (const ReportFormat& format : report_formats()) {
    EXPECT_NE(help.find(std::string("--") + format.name + " F"), std::string::npos) << format.name;
    arguments.insert(arguments.end(), {std::string("--") + format.name, folder_.file(format.name)});
  }
  EXPECT_EQ(diagnose(arguments).status, 1);
  for (const ReportFormat& format : report_formats())
    EXPECT_FALSE(read_file(folder_.file(format.name)).empty()) << format.name;
}

TEST_F(DiagnoseReports, ATerminalShowsHowMuchOfALongLogWasRead) {
  const std::string path = folder_.file("long.csv");
  write_log(path, simulate(small_robot(), small_run(kLong_s), 31).log);
  const std::string command =
      "'" FAULTLINE_PROGRAM "' diagnose '" + path + "' --model '" + model_ + "' --color never";
  const ProgramRun run = run_command({"script", "-qec", command, "/dev/null"});
  EXPECT_EQ(run.status, 0) << run.out;
  EXPECT_NE(run.out.find("% diagnosing "), std::string::npos) << run.out;
  const std::size_t hidden = run.out.rfind("\r\x1b[K");
  ASSERT_NE(hidden, std::string::npos) << run.out;
  EXPECT_LT(hidden, run.out.find("Log    ")) << "the result is written after the bar was removed";
}

}  // namespace
}  // namespace faultline
