// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/formats/read_csv.hpp"

namespace faultline {
namespace {

using Values = std::vector<double>;

TEST(CsvReader, CanonicalColumnsNeedNoMapping) {
  const auto [log, identity, issues] =
      read_csv("t,q1,q2,dq1,dq2,tau1,tau2\n0,1,2,3,4,5,6\n0.1,1.5,2.5,3,4,5,6\n");
  EXPECT_EQ(log.time, (Values{0, 0.1}));
  EXPECT_EQ(log.q, (JointSignals{{1, 1.5}, {2, 2.5}}));
  EXPECT_EQ(log.dq, (JointSignals{{3, 3}, {4, 4}}));
  EXPECT_EQ(log.tau, (JointSignals{{5, 5}, {6, 6}}));
  EXPECT_TRUE(issues.empty());
  EXPECT_EQ(identity.format, "csv");
}

TEST(CsvReader, SemicolonsAndDecimalCommasAreRead) {
  const Log log = read_csv("t;q1;q2\n0;1,5;-2\n0,1;1,25e-1;3\n").log;
  EXPECT_EQ(log.time, (Values{0, 0.1}));
  EXPECT_EQ(log.q, (JointSignals{{1.5, 0.125}, {-2, 3}}));
}

TEST(CsvReader, TabsBlanksBarsAndCommasWithBlanksSeparateFields) {
  for (const char* separator : {"\t", "  ", " ", "|", ", ", " ; "}) {
    std::string text = "t,q1,tau1\n0,1.5,2\n0.1,-1.5,3\n";
    for (std::size_t at; (at = text.find(',')) != std::string::npos && std::string(separator) != ", ";)
      text.replace(at, 1, separator);
    if (std::string(separator) == ", ") text = "t, q1, tau1\n0, 1.5, 2\n0.1, -1.5, 3\n";
    const Log log = read_csv(text).log;
    EXPECT_EQ(log.q, (JointSignals{{1.5, -1.5}})) << separator;
    EXPECT_EQ(log.tau, (JointSignals{{2, 3}})) << separator;
  }
}

TEST(CsvReader, QuotesCommentsByteOrderMarkAndCarriageReturnsAreIgnored) {
  const Log log =
      read_csv("\xEF\xBB\xBF# a robot\r\n\"t\",\"q1\"\r\n\"0\",\"1.5\"\r\n% pause\r\n\r\n0.1,2.5\r\n").log;
  EXPECT_EQ(log.time, (Values{0, 0.1}));
  EXPECT_EQ(log.q, (JointSignals{{1.5, 2.5}}));
}

TEST(CsvReader, AHeaderAfterACommentSignIsRead) {
  EXPECT_EQ(read_csv("# t q1 tau1\n0 1 2\n0.5 3 4\n").log.tau, (JointSignals{{2, 4}}));
}

TEST(CsvReader, LinesBeforeTheTableAreLeftOutAndCounted) {
  const auto [log, identity, issues] =
      read_csv("Robot 7, cell 2\nspeed: 3\n\nt,q1,tau1\n0,1,2\n1,3,4\n2,4,5\n");
  EXPECT_EQ(log.q, (JointSignals{{1, 3, 4}}));
  ASSERT_NE(issues.find("preamble_skipped"), nullptr);
  EXPECT_EQ(issues.find("preamble_skipped")->count, 2);
}

TEST(CsvReader, UnitsInTheHeaderAreHonoured) {
  const Log log =
      read_csv("time_ms,q1 [deg],q2 (mm),dq1 [rad/s],dq2 [mm/s]\n0,180,1000,1,500\n10,90,500,1,500\n").log;
  EXPECT_DOUBLE_EQ(log.time[1], 0.01);
  EXPECT_DOUBLE_EQ(log.q[0][0], M_PI);
  EXPECT_DOUBLE_EQ(log.q[1][1], 0.5);
  EXPECT_DOUBLE_EQ(log.dq[0][1], 1.0);
  EXPECT_DOUBLE_EQ(log.dq[1][1], 0.5);
}

TEST(CsvReader, UnitsInTheirOwnLineAreHonoured) {
  EXPECT_DOUBLE_EQ(read_csv("t,q1\nms,deg\n0,180\n10,90\n").log.q[0][0], M_PI);
}

TEST(CsvReader, TheColumnMapSetsNameUnitSignScaleAndOffset) {
  OpenLogOptions options;
  options.columns["t"] = {.name = "stamp", .unit = "us"};
  options.columns["q1"] = {.name = "enc", .unit = "deg", .sign = -1, .scale = 2, .offset = 1};
  const Log log = read_csv("stamp,enc\n0,0\n1000,90\n", options).log;
  EXPECT_DOUBLE_EQ(log.time[1], 1e-3);
  EXPECT_DOUBLE_EQ(log.q[0][1], 1.0 - M_PI);
}

TEST(CsvReader, RowNumbersReplaceAMissingTime) {
  OpenLogOptions options;
  options.columns["t"] = {.name = "@row", .scale = 0.5};
  EXPECT_EQ(read_csv("q1\n7\n8\n9\n", options).log.time, (Values{0, 0.5, 1.0}));
}

TEST(CsvReader, OneColumnMayServeTwoChannels) {
  OpenLogOptions options;
  options.columns["q_ref1"] = {.name = "q1", .offset = 1};
  const Log log = read_csv("t,q1\n0,5\n1,6\n", options).log;
  EXPECT_EQ(log.q, (JointSignals{{5, 6}}));
  EXPECT_EQ(log.q_ref, (JointSignals{{6, 7}}));
}

TEST(CsvReader, TextInPlaceOfANumberIsMissingAndReportedWithItsPlace) {
  const auto [log, identity, issues] = read_csv("t,q1,tau1\n0,1,2\n1,oops,3\n2,4,bad\n3,worse,5\n");
  EXPECT_TRUE(std::isnan(log.q[0][1]));
  EXPECT_TRUE(std::isnan(log.q[0][3]));
  const Issue* issue = issues.find("not_a_number", "q1");
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->count, 2);
  EXPECT_EQ(issue->first_row, 2);
  for (const char* word : {"row 2", "line 3", "\"q1\"", "\"oops\""})
    EXPECT_NE(issue->message.find(word), std::string::npos) << issue->message;
}

TEST(CsvReader, EmptyCellsAreMissingWithoutAnIssue) {
  const auto [log, identity, issues] = read_csv("t,q1,q2\n0,1,\n1,,2\n2,nan,NULL\n");
  EXPECT_TRUE(std::isnan(log.q[1][0]) && std::isnan(log.q[0][1]) && std::isnan(log.q[0][2]));
  EXPECT_EQ(log.q[1][1], 2);
  EXPECT_TRUE(issues.empty());
}

TEST(CsvReader, InfinityBecomesMissingWithAnIssue) {
  const auto [log, identity, issues] = read_csv("t,q1\n0,1\n1,inf\n2,1e282\n");
  EXPECT_TRUE(std::isnan(log.q[0][1]) && std::isnan(log.q[0][2]));
  ASSERT_NE(issues.find("value_implausible", "q1"), nullptr);
  EXPECT_EQ(issues.find("value_implausible", "q1")->count, 2);
}

TEST(CsvReader, ShortRowsAreFilledLongRowsAreLeftOut) {
  const auto [log, identity, issues] = read_csv("t,q1,q2\n0,1,2\n1,3\n2,4,5,6\n3,7,8\n");
  EXPECT_EQ(log.time, (Values{0, 1, 3}));
  EXPECT_TRUE(std::isnan(log.q[1][1]));
  ASSERT_NE(issues.find("ragged_row"), nullptr);
  ASSERT_NE(issues.find("row_too_long"), nullptr);
  EXPECT_EQ(issues.find("row_too_long")->first_row, 3);
  EXPECT_EQ(issues.rows_dropped(), 1);
}

TEST(CsvReader, TruncatedLastLineIsLeftOut) {
  const auto [log, identity, issues] = read_csv("t,q1,q2\n0,1,2\n1,3,4\n2,5");
  EXPECT_EQ(log.rows(), 2);
  ASSERT_NE(issues.find("truncated_last_line"), nullptr);
  EXPECT_EQ(issues.find("truncated_last_line")->first_row, 3);
}

TEST(CsvReader, CompleteLastLineWithoutNewlineIsKept) {
  const auto [log, identity, issues] = read_csv("t,q1,q2\n0,1,2\n1,3,4");
  EXPECT_EQ(log.rows(), 2);
  ASSERT_EQ(issues.all().size(), 1u);
  EXPECT_EQ(issues.all()[0].code, "last_line_open");
}

TEST(CsvReader, HeaderRepeatedWhereFilesWereJoinedIsLeftOut) {
  const auto [log, identity, issues] = read_csv("t,q1\n0,1\nt,q1\n1,2\n");
  EXPECT_EQ(log.q, (JointSignals{{1, 2}}));
  EXPECT_NE(issues.find("header_repeated"), nullptr);
}

TEST(CsvReader, ALaterHeaderWithTheColumnsInAnotherOrderIsFollowed) {
  const auto [log, identity, issues] =
      read_csv("t,q1,q2\n0,1,2\n1,3,4\nq2,t,q1\n6,2,5\n8,3,7\nt,q1,q2\n4,9,10\n");
  EXPECT_EQ(log.time, (std::vector<double>{0, 1, 2, 3, 4}));
  EXPECT_EQ(log.q, (JointSignals{{1, 3, 5, 7, 9}, {2, 4, 6, 8, 10}}));
  const Issue* issue = issues.find("header_changed");
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->first_row, 3);
  EXPECT_EQ(issue->count, 2);
}

TEST(CsvReader, RowsBelowALaterHeaderWithOtherColumnsAreLeftOut) {
  const auto [log, identity, issues] =
      read_csv("t,q1,q2\n0,1,2\n1,3,4\nt,q1,temperature\n2,5,20\n3,7,21\nt,q1,q2\n4,9,10\n");
  EXPECT_EQ(log.q, (JointSignals{{1, 3, 9}, {2, 4, 10}}));
  const Issue* issue = issues.find("other_table");
  ASSERT_NE(issue, nullptr);
  EXPECT_EQ(issue->severity, Severity::severe);
  EXPECT_EQ(issue->first_row, 3);
  EXPECT_EQ(issue->rows_dropped, 2);
  EXPECT_EQ(identity.rows_read, log.rows() + issues.rows_dropped());
}

TEST(CsvReader, TwoColumnsOfOneNameAreRefused) {
  const std::string why = why_refused("t,q1,q2,q1\n0,1,2,3\n");
  for (const char* word : {"log.csv", "\"q1\"", "columns 2 and 4"})
    EXPECT_NE(why.find(word), std::string::npos) << why;
}

TEST(CsvReader, MissingColumnsAreRefusedWithTheLineThatMapsThem) {
  const std::string no_time = why_refused("alpha,q1\n0,1\n");
  for (const char* word : {"time", "\"alpha\"", "[log.columns] t = "})
    EXPECT_NE(no_time.find(word), std::string::npos) << no_time;
  const std::string no_position = why_refused("t,alpha,beta\n0,1,2\n");
  for (const char* word : {"position", "\"beta\"", "[log.columns] q1 = "})
    EXPECT_NE(no_position.find(word), std::string::npos) << no_position;
  OpenLogOptions options;
  options.columns["tau2"] = {.name = "gamma"};
  EXPECT_NE(why_refused("t,q1,q2\n0,1,2\n", options).find("\"gamma\""), std::string::npos);
}

TEST(CsvReader, UnknownUnitOfTheColumnMapIsAUsageError) {
  OpenLogOptions options;
  options.columns["q1"] = {.unit = "furlong"};
  EXPECT_NE(why_refused("t,q1\n0,1\n", options).find("furlong"), std::string::npos);
}

TEST(CsvReader, AFileWithOnlyAHeaderIsRefused) {
  EXPECT_NE(why_refused("t,q1,tau1\n").find("no data row"), std::string::npos);
}

TEST(CsvReader, AFileWithoutUsableTimeIsRefused) {
  EXPECT_NE(why_refused("t,q1\nx,1\ny,2\n").find("usable time"), std::string::npos);
}

TEST(CsvReader, ColumnsWithoutAHeaderAreNumberedAndNeedTheColumnMap) {
  EXPECT_NE(why_refused("0,1,2\n1,3,4\n").find("\"column2\""), std::string::npos);
  OpenLogOptions options;
  options.columns["t"] = {.name = "column1"};
  options.columns["q1"] = {.name = "column3"};
  const auto [log, identity, issues] = read_csv("0,1,2\n1,3,4\n", options);
  EXPECT_EQ(log.q, (JointSignals{{2, 4}}));
  EXPECT_NE(issues.find("no_header"), nullptr);
}

TEST(CsvReader, NamesInRowsBecomeColumns) {
  const Log log = read_csv(
                      "1760365398,710681477,,state.j2/position,0.5,state.j1/position,1.5,load,3\n"
                      "1760365398,730681477,,state.j2/position,0.6,state.j1/position,1.6,load,3\n")
                      .log;
  EXPECT_EQ(log.q, (JointSignals{{1.5, 1.6}, {0.5, 0.6}}));
  EXPECT_NEAR(log.time[1] - log.time[0], 0.02, 1e-6);
}

TEST(CsvReader, SparseRowsAreKeptWithMissingValues) {
  const auto [log, identity, issues] = read_csv("t,q1,extra\n0,1,\n0.1,,7\n0.2,2,\n0.3,,8\n");
  EXPECT_EQ(log.rows(), 4);
  EXPECT_TRUE(std::isnan(log.q[0][1]));
  ASSERT_EQ(log.extra.size(), 1u);
  EXPECT_EQ(log.extra[0].values[3], 8);
}

TEST(CsvReader, ExtraColumnsCanBeLeftOut) {
  OpenLogOptions options;
  options.keep_extra = false;
  const Log log = read_csv("t,note,q1\n0,\"a, b\",1\n1,c,2\n", options).log;
  EXPECT_TRUE(log.extra.empty());
  EXPECT_EQ(log.q, (JointSignals{{1, 2}}));
}

TEST(CsvReader, BinaryBytesAreRefused) {
  EXPECT_NE(why_refused(std::string("t,q1\n0,\0\n", 9)).find("unknown format"), std::string::npos);
}

}  // namespace
}  // namespace faultline
