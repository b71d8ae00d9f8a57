// SPDX-License-Identifier: MIT
// The commands on a robot whose logs have no torque.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lib/core/atomic_file.hpp"
#include "tests/residual/relation/stepped_joint.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

std::string csv_of(const Log& log) {
  std::string text = "t,q1,dq1,q_ref1,dq_ref1\n";
  for (int k = 0; k < log.rows(); ++k)
    text += fmt::format("{:.3f},{:.6f},{:.5f},{:.6f},{:.6f}\n", log.time[k], log.q[0][k], log.dq[0][k],
                        log.q_ref[0][k], log.dq_ref[0][k]);
  return text;
}

class TrackingCommands : public testing::Test {
 protected:
  TrackingCommands() {
    for (const std::uint64_t seed : {1, 2})
      healthy_.push_back(
          folder_.write(fmt::format("healthy_{}.csv", seed), csv_of(SteppedJoint{.seed = seed}.log(30.0))));
    stall_ = folder_.write(
        "stall.csv", csv_of(SteppedJoint{.stall_from_s = 9.0, .stall_to_s = 10.0, .seed = 5}.log(20.0)));
    model_ = folder_.file("stepper.model");
    learned_ = run_program({"learn", healthy_[0], healthy_[1], "--robot", "R", "-o", model_});
  }

  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  TemporaryFolder folder_;
  std::vector<std::string> healthy_;
  std::string stall_, model_;
  ProgramRun learned_;
};

TEST_F(TrackingCommands, LearnReportsTheReferencesAndNoIdentification) {
  ASSERT_EQ(learned_.status, 0) << learned_.err;
  EXPECT_TRUE(has(learned_.out, "have no torque")) << learned_.out;
  EXPECT_TRUE(has(learned_.out, "Joint 1: the reference, for the position,"));
  EXPECT_FALSE(has(learned_.out, "Identified"));
}

TEST_F(TrackingCommands, DiagnoseNamesTheStallInEveryFormat) {
  const std::string html = folder_.file("stall.html"), json = folder_.file("stall.json");
  const ProgramRun run = run_program({"diagnose", stall_, "--model", model_, "--html", html, "--json", json});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(has(run.out, "joint 1 is locked")) << run.out;
  EXPECT_TRUE(has(run.out, "stands still while its reference moves"));
  EXPECT_TRUE(has(read_file(html), "reference"));
  EXPECT_TRUE(has(read_file(json), "\"decided_by\": \"tracking\""));
  EXPECT_EQ(run_program({"diagnose", healthy_[0], "--model", model_}).status, 0);
}

TEST_F(TrackingCommands, CasesAndGoldenLogsAcceptAFaultOfTracking) {
  const std::string json = folder_.file("stall.json");
  ASSERT_EQ(run_program({"diagnose", stall_, "--model", model_, "--json", json}).status, 1);
  const ProgramRun added = run_program(
      {"cases", "add", json, "--fault", "locked", "--joint", "1", "--done", "brake", "--model", model_});
  EXPECT_EQ(added.status, 0) << added.err;
  const std::string golden = folder_.file("golden");
  const ProgramRun recorded =
      run_program({"golden", "record", healthy_[0], stall_, "--model", model_, "-o", golden});
  EXPECT_EQ(recorded.status, 0) << recorded.err;
  const ProgramRun checked = run_program({"golden", "check", golden});
  EXPECT_EQ(checked.status, 0) << checked.out << checked.err;
}

TEST_F(TrackingCommands, ABudgetOfFalseAlarmsIsAPositiveNumber) {
  const ProgramRun run = run_program(
      {"learn", healthy_[0], "--robot", "R", "--alarms-per-hour", "0", "-o", folder_.file("other.model")});
  EXPECT_EQ(run.status, 2);
  EXPECT_TRUE(has(run.err, "alarms_per_hour")) << run.err;
}

TEST_F(TrackingCommands, LabelledLogsAreRefusedWithTheReason) {
  const std::string labels = folder_.write("labels.csv", "file,fault,joint,onset_s\nstall.csv,locked,1,9\n");
  const ProgramRun run = run_program(
      {"learn", healthy_[0], stall_, "--labels", labels, "--robot", "R", "-o", folder_.file("other.model")});
  EXPECT_EQ(run.status, 3);
  EXPECT_TRUE(has(run.err, "stall.csv") && has(run.err, "leave labelled logs out")) << run.err;
}

}  // namespace
}  // namespace faultline
