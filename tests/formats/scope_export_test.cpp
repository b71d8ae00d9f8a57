// SPDX-License-Identifier: MIT
// Exports of TwinCAT Scope: lines on the project, lines on the channels with a key above each time column,
// values.
#include "formats/csv/scope_export.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tests/formats/read_csv.hpp"

namespace faultline {
namespace {

using Values = std::vector<double>;

constexpr const char* kProject =
    "Name\tScope Project\nFile\tC:\\run.csv\nStarttime of export\t132959733843760000\tMontag, 2. Mai 2022\t"
    "15:56:24.376\nEndtime of export\t132959733853750000\tMontag, 2. Mai 2022\t15:56:25.375\n\n\n";

/// Lines on channels of one sample time that share a time column.
constexpr const char* kSharedTime =
    "Name\tAxis 1.ActPos\tAxis 2.ActPos\tAxis 1.ActTorque\n"
    "SymbolComment\t\t\t\nData-Type\tREAL64\tREAL64\tREAL32\nSampleTime[ms]\t2\t2\t2\n"
    "VariableSize\t8\t8\t4\nSymbolName\tMAIN.a\tMAIN.b\tMAIN.c\nPort\t851\t851\t851\n"
    "Offset\t0\t0\t0\nScaleFactor\t1\t1\t1\nUnit\tdeg (Angle)\tdeg (Angle)\t(None)\n\n";

TEST(ScopeExport, ChannelsOfOneSampleTimeAreReadWithTheirUnits) {
  const auto [log, identity, issues] =
      read_csv(std::string(kProject) + kSharedTime + "0\t180\t-90\t1,5\n2\t90\t-45\t2,5\n4\t0\t0\t3,5\n");
  EXPECT_EQ(log.time, (Values{0, 0.002, 0.004}));
  EXPECT_DOUBLE_EQ(log.q[0][0], M_PI);
  EXPECT_DOUBLE_EQ(log.q[1][1], -M_PI / 4);
  EXPECT_EQ(log.tau[0], (Values{1.5, 2.5, 3.5}));
  ASSERT_EQ(issues.all().size(), 1u);  // of the torque that is not there
  EXPECT_EQ(issues.all()[0].code, "channel_missing");
}

TEST(ScopeExport, EachChannelMayHaveATimeColumnOfTheSameTimes) {
  const auto [log, identity, issues] =
      read_csv(std::string(kProject) +
               "Name;q1;Name;q2;Name;tau1\nSampleTime[ms];2;SampleTime[ms];2;"
               "SampleTime[ms];2\n\n0;1,5;0;2,5;0;7\n2;1,25;2;2;2;8\n");
  EXPECT_EQ(log.time, (Values{0, 0.002}));
  EXPECT_EQ(log.q, (JointSignals{{1.5, 1.25}, {2.5, 2}}));
  EXPECT_EQ(log.tau[0], (Values{7, 8}));
  EXPECT_TRUE(log.extra.empty());
}

TEST(ScopeExport, OnlyTheNamesAboveTheValuesAreNeeded) {
  const Log log = read_csv("Name,q1,Name,q2\n0,1.5,0,3\n4,2.5,4,4\n").log;
  EXPECT_EQ(log.time, (Values{0, 0.004}));
  EXPECT_EQ(log.q, (JointSignals{{1.5, 2.5}, {3, 4}}));
}

/// q1 = 2 t (t in ms) each ms; the torque is 100 t each 2 ms, so its export has half as many values.
std::string two_sample_times(int rows, bool filled) {
  std::string text = std::string(kProject) +
                     "Name\ttau1\tName\tq1\tq2\nSampleTime[ms]\t2\tSampleTime[ms]\t1\t1\n"
                     "SymbolName\tMAIN.c\tSymbolName\tMAIN.a\tMAIN.b\n\n";
  for (int i = 0; i < rows; ++i) {
    const int slow = filled ? i / 2 : i;
    text += 2 * slow < rows ? fmt::format("{}\t{}", 2 * slow, 200 * slow) : "\t";
    text += fmt::format("\t{}\t{}\t{}\n", i, 2 * i, 3 * i);
  }
  return text;
}

TEST(ScopeExport, ChannelsOfAnotherSampleTimeAreTakenAtTheTimesOfThePositions) {
  for (const bool filled : {false, true}) {
    const auto [log, identity, issues] = read_csv(two_sample_times(400, filled));
    ASSERT_EQ(log.rows(), 400);
    for (int i = 0; i < 399; ++i) {
      EXPECT_DOUBLE_EQ(log.time[i], 0.001 * i);
      EXPECT_EQ(log.q[1][i], 3 * i);
      EXPECT_DOUBLE_EQ(log.tau[0][i], 100 * i) << i;
    }
    EXPECT_TRUE(std::isnan(log.tau[0][399]));  // behind the last torque
    const Issue* issue = issues.find("scope_sample_times");
    ASSERT_NE(issue, nullptr);
    EXPECT_EQ(issue->severity, Severity::warning);
    EXPECT_NE(issue->message.find("with steps of 1; "), std::string::npos) << issue->message;
    EXPECT_NE(issue->message.find("with steps of 2,"), std::string::npos) << issue->message;
    EXPECT_EQ(issues.find("ragged_row"), nullptr);
    EXPECT_EQ(issues.find("join_rows_left"), nullptr);
  }
}

TEST(ScopeExport, ShorterRowsBelowTheLastValueOfSlowChannelsAreNoDefect) {
  std::string text = "Name\tq1\tq2\tName\ttemperature\nSampleTime[ms]\t1\t1\tSampleTime[ms]\t10\n\n";
  for (int i = 0; i < 40; ++i)
    text += fmt::format("{}\t{}\t{}{}\n", i, i, 2 * i, i < 4 ? fmt::format("\t{}\t{}", 10 * i, 20 + i) : "");
  const auto [log, identity, issues] = read_csv(text + "EOF\n");
  EXPECT_EQ(log.rows(), 40);
  EXPECT_EQ(log.q[1][39], 78);
  ASSERT_EQ(log.extra.size(), 1u);
  EXPECT_EQ(log.extra[0].values[30], 23);
  EXPECT_DOUBLE_EQ(log.extra[0].values[15], 21.5);
  EXPECT_EQ(issues.find("ragged_row"), nullptr);
  ASSERT_NE(issues.find("scope_sample_times"), nullptr);
  EXPECT_EQ(issues.find("scope_sample_times")->severity, Severity::note);
}

TEST(ScopeExport, FullTimestampsBecomeSecondsSince1970) {
  const Log log = read_csv(std::string(kProject) + kSharedTime +
                           "132959733843760000\t1\t2\t3\n132959733843780000\t2\t3\t4\n")
                      .log;
  EXPECT_NEAR(log.time[0], 1651499784.376, 2e-6);
  EXPECT_NEAR(log.time[1] - log.time[0], 0.002, 4e-6);
}

TEST(ScopeExport, AnOffsetInTheHeaderIsReportedBecauseTheFileDoesNotShowWhetherItIsInTheValues) {
  const auto [log, identity, issues] = read_csv(
      "Name\tq1\ttau1\nData-Type\tREAL64\tINT16\nOffset\t0\t1\nScaleFactor\t1\t-0,1\n\n0\t1\t2\n1\t2\t3\n");
  EXPECT_EQ(log.tau[0], (Values{2, 3}));
  const Issue* issue = issues.find("scope_scaling");
  ASSERT_NE(issue, nullptr);
  EXPECT_NE(issue->message.find("\"tau1\""), std::string::npos) << issue->message;
}

TEST(ScopeExport, TwoChannelsOfOneNameAreNamedByTheirSymbols) {
  const Log log = read_csv(
                      "Name\tActPos\tActPos\tActPos\nSymbolName\tMAIN.Axis_1.ActPos\tMAIN.Axis_2.ActPos\t"
                      "MAIN.Axis_1.ActPos\n\n0\t1\t2\t1\n1\t3\t4\t3\n")
                      .log;
  EXPECT_EQ(log.q, (JointSignals{{1, 3}, {2, 4}}));
}

TEST(ScopeExport, AHeaderLongerThanTheHeadOfTheFileIsRead) {
  std::string names = "Name\tq1", types = "Data-Type\tREAL64", symbols = "SymbolName\tMAIN.q1",
              units = "Unit\t(None)", row = "\t5";
  for (int i = 0; i < 900; ++i) {
    names += fmt::format("\tchannel_of_a_machine_{}", i);
    types += "\tREAL64";
    symbols += fmt::format("\tMAIN.fbMachine.channel_of_a_machine_{}", i);
    units += "\tdV (Voltage)";
    row += "\t1";
  }
  const Log log =
      read_csv(names + "\n" + types + "\n" + symbols + "\n" + units + "\n\n0" + row + "\n1" + row + "\n").log;
  EXPECT_EQ(log.q, (JointSignals{{5, 5}}));
  EXPECT_EQ(log.extra.size(), 900u);
}

TEST(ScopeExport, MoreTimesThanTablesMayBeJoinedAreRefusedWithTheWayOut) {
  std::string names, rows[3];
  for (int i = 0; i < 40; ++i) {
    names += fmt::format("{}Name\tc{}", i ? "\t" : "", i);
    for (int row = 0; row < 3; ++row) rows[row] += fmt::format("{}{}\t1", i ? "\t" : "", row * (i + 1));
  }
  const std::string why = why_refused(names + "\n" + rows[0] + "\n" + rows[1] + "\n" + rows[2] + "\n");
  EXPECT_NE(why.find("record the joints with one sample time"), std::string::npos) << why;
}

TEST(ScopeExport, ATableWithAColumnCalledNameIsNoExport) {
  const Log log = read_csv("Name,t,q1\nrun,0,1\nrun,1,2\n").log;
  EXPECT_EQ(log.q, (JointSignals{{1, 2}}));
}

TEST(ScopeExport, TheSegmentsOfALogDoNotDependOnItsBlocks) {
  OpenLogOptions options;
  options.segment_rows = 7;
  const std::string text = two_sample_times(200, false);
  const Log small = read_csv(text, options).log, large = read_csv(text).log;
  EXPECT_EQ(small.time, large.time);
  EXPECT_EQ(std::vector<double>(small.tau[0].begin(), small.tau[0].end() - 1),
            std::vector<double>(large.tau[0].begin(), large.tau[0].end() - 1));
}

}  // namespace
}  // namespace faultline
