// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "lib/core/atomic_file.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace faultline {
namespace {

using Json = nlohmann::json;

/// One joint at 100 Hz that moves; from row `gap_after` on 2 s later, with torque or without.
std::string log_text(int rows, int gap_after = 1 << 30, bool torque = true) {
  std::string text = torque ? "t,q1,dq1,tau1\n" : "t,q1\n";
  for (int i = 0; i < rows; ++i) {
    const double t = 0.01 * i;
    text += std::to_string(i > gap_after ? t + 2.0 : t) + "," + std::to_string(std::sin(2.0 * t));
    if (torque)
      text += "," + std::to_string(2.0 * std::cos(2.0 * t)) + "," + std::to_string(-4.0 * std::sin(2.0 * t));
    text += "\n";
  }
  return text;
}

Json inspected(const std::string& text) {
  const TemporaryFolder folder;
  const ProgramRun run = run_program({"inspect", folder.write("run.csv", text), "--json", "-"});
  EXPECT_LE(run.status, 1) << run.err;
  return Json::parse(run.out).at("logs").at(0);
}

Json analysis(const Json& log, const std::string& name) {
  for (const Json& one : log.at("analyses"))
    if (one.at("name") == name) return one;
  ADD_FAILURE() << name;
  return {};
}

TEST(InspectionReport, AHealthyLogIsSoundCompleteAndFitForTorqueAnalyses) {
  const Json log = inspected(log_text(2000));
  EXPECT_EQ(log.at("verdict"), "sound");
  EXPECT_EQ(log.at("completeness"), 1.0);
  EXPECT_EQ(log.at("share_used"), 1.0);
  EXPECT_TRUE(log.at("time").at("listed_gaps").empty());
  for (const char* name : {"identify", "learn", "torque_residuals", "motion"})
    EXPECT_EQ(analysis(log, name).at("fit"), "possible") << name;
  EXPECT_EQ(analysis(log, "tracking").at("fit"), "impossible");
}

TEST(InspectionReport, JudgesOnlyTheRecordingAndRefersToDiagnoseForTheRobot) {
  const TemporaryFolder folder;
  const std::string log = folder.write("run.csv", log_text(2000)), page = folder.file("page.html");
  const std::string text = run_program({"inspect", log, "--html", page}).out;
  for (const std::string& shown : {text, read_file(page)}) {
    EXPECT_NE(shown.find("he recording is sound"), std::string::npos) << shown.substr(0, 2000);
    EXPECT_NE(shown.find("faultline diagnose"), std::string::npos);
    EXPECT_EQ(shown.find("nothing wrong was found"), std::string::npos);
  }
}

TEST(InspectionReport, GapsAreListedAndReduceTheCompleteness) {
  const Json log = inspected(log_text(2000, 999));
  EXPECT_EQ(log.at("verdict"), "doubtful");
  const Json gap = log.at("time").at("listed_gaps").at(0);
  EXPECT_EQ(gap.at("after_row"), 1000);
  EXPECT_NEAR(gap.at("start_s"), 9.99, 1e-9);
  EXPECT_NEAR(gap.at("length_s"), 2.01, 1e-9);
  EXPECT_NEAR(log.at("completeness"), 2000.0 / 2200.0, 1e-3);
}

TEST(InspectionReport, ALogWithoutTorqueAllowsOnlyMotionAnalysis) {
  const Json log = inspected(log_text(2000, 1 << 30, false));
  for (const char* name : {"identify", "learn", "torque_residuals"}) {
    EXPECT_EQ(analysis(log, name).at("fit"), "impossible") << name;
    EXPECT_EQ(analysis(log, name).at("why"), "there is no torque") << name;
  }
  EXPECT_EQ(analysis(log, "motion").at("fit"), "limited");
}

TEST(InspectionReport, AShortLogIsOfLimitedUseForIdentification) {
  EXPECT_EQ(analysis(inspected(log_text(100)), "identify").at("fit"), "limited");
  EXPECT_EQ(analysis(inspected(log_text(3)), "identify").at("fit"), "impossible");
}

TEST(InspectionReport, ATableWithoutJointsAllowsNoAnalysis) {
  const Json log = inspected("a,b\n1,2\n3,4\n");
  EXPECT_EQ(log.at("verdict"), "no_joint_log");
  EXPECT_EQ(analysis(log, "motion").at("fit"), "impossible");
}

TEST(InspectionReport, ThePageNeedsNoScriptAndMarksAGap) {
  const TemporaryFolder folder;
  const std::string page = folder.file("page.html");
  const auto page_of = [&](const std::string& text) {
    EXPECT_LE(run_program({"inspect", folder.write("run.csv", text), "--html", page}).status, 1);
    return read_file(page);
  };
  const std::string whole = page_of(log_text(2000)), gap = page_of(log_text(2000, 999));
  EXPECT_EQ(whole.find("<script"), std::string::npos);
  EXPECT_NE(whole.find("script-src 'none'"), std::string::npos);
  EXPECT_NE(whole.find("joint 1: torque"), std::string::npos);
  EXPECT_EQ(whole.find("fill-opacity"), std::string::npos);
  EXPECT_NE(gap.find("fill-opacity"), std::string::npos);
  EXPECT_NE(gap.find("sable with care"), std::string::npos);
}

TEST(InspectionReport, ThePageOfALongLogStaysSmall) {
  const TemporaryFolder folder;
  const auto size_of = [&](int rows) {
    const std::string page = folder.file("page.html");
    EXPECT_EQ(run_program({"inspect", folder.write("run.csv", log_text(rows)), "--html", page}).status, 0);
    return read_file(page).size();
  };
  EXPECT_LT(static_cast<double>(size_of(40000)), 1.3 * static_cast<double>(size_of(1000)));
}

}  // namespace
}  // namespace faultline
