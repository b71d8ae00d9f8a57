// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "formats/open_log.hpp"
#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

const std::string kPosition = "t,q1\n0,1\n0.1,2\n0.2,3\n";
const std::string kTorque = "tau1\n10\n20\n30\n";

TEST(LogSelectionOptions, ConvertWritesOneLogOfSeveralFiles) {
  const TemporaryFolder folder;
  const std::string q = folder.write("q.csv", kPosition), tau = folder.write("tau.csv", kTorque);
  const std::string next = folder.write("next.csv", "q1,t\n4,0.3\n");
  const ProgramRun joined = run_program({"convert", q, "-", "--join", tau});
  EXPECT_EQ(joined.status, 0) << joined.err;
  EXPECT_EQ(joined.out, "t,q1,tau1\n0,1,10\n0.1,2,20\n0.2,3,30\n");
  const ProgramRun longer = run_program({"convert", q, "-", "--then", next});
  EXPECT_EQ(longer.out, "t,q1\n0,1\n0.1,2\n0.2,3\n0.3,4\n");
  const std::string last = folder.write("last.csv", "t,q1\n0.4,5\n");
  const ProgramRun all = run_program({"convert", "--then", next, q, "--then", last, "-"});
  EXPECT_EQ(all.out, "t,q1\n0,1\n0.1,2\n0.2,3\n0.3,4\n0.4,5\n") << all.err;
}

TEST(LogSelectionOptions, InspectSeesTheJoinedColumns) {
  const TemporaryFolder folder;
  const std::string q = folder.write("q.csv", kPosition), tau = folder.write("tau.csv", kTorque);
  const ProgramRun run = run_program({"inspect", q, "--join", tau, "--join-by", "row"});
  EXPECT_NE(run.out.find("tau1"), std::string::npos) << run.out << run.err;
}

TEST(LogSelectionOptions, AnOutputThatIsAPartOfTheLogIsRefused) {
  const TemporaryFolder folder;
  const std::string q = folder.write("q.csv", kPosition), tau = folder.write("tau.csv", kTorque);
  EXPECT_EQ(run_program({"convert", q, tau, "--join", tau}).status, 2);
  EXPECT_EQ(read_file(tau), kTorque);
}

TEST(LogSelectionOptions, AnInvalidOptionValueIsAUsageError) {
  const TemporaryFolder folder;
  const std::string q = folder.write("q.csv", kPosition);
  EXPECT_EQ(run_program({"convert", q, "-", "--join", q, "--join-by", "colour"}).status, 2);
  EXPECT_EQ(run_program({"convert", q, "-", "--run", "0"}).status, 2);
}

TEST(ConvertToMcap, HoldsTheEventsOfADiagnosis) {
  const TemporaryFolder folder;
  const std::string log = folder.write("q.csv", kPosition);
  const std::string report =
      folder.write("report.json",
                   R"({"schema": "faultline/diagnosis/1", "faults": [{"id": 1, "kind": "locked", "joint": 1,
                       "onset_s": 0.1, "alarm_s": 0.15, "end_s": null, "confidence": 0.9}]})");
  const std::string out = folder.file("run.mcap");
  const ProgramRun run = run_program({"convert", log, out, "--diagnosis", report});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read_all(*open_log(out)).q[0], (std::vector<double>{1, 2, 3}));
  EXPECT_NE(read_file(out).find("/faultline/diagnosis"), std::string::npos);
  EXPECT_EQ(run_program({"convert", log, folder.file("run.flog"), "--diagnosis", report}).status, 2);
  const ProgramRun wrong = run_program({"convert", log, out, "--diagnosis", folder.write("x.json", "{}")});
  EXPECT_EQ(wrong.status, 3);
  EXPECT_NE(wrong.err.find("diagnose --json"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace faultline
