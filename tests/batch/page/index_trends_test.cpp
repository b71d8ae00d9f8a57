// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/batch/page/index_page.hpp"

namespace faultline {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

BatchRow row(const std::string& log, double start_s, double residual) {
  BatchRow made;
  made.log = log;
  made.verdict = "healthy";
  made.start_s = start_s;
  made.end_s = start_s + 10.0;
  made.joints = 2;
  made.residual_rms = {residual, 1.0};
  return made;
}

std::vector<BatchRow> dated() {
  return {row("a/1.csv", 1.7e9 + 200.0, 3.0), row("a/2.csv", 1.7e9, 1.0), row("b/3.csv", 1.7e9 + 100.0, 2.0)};
}

TEST(IndexTrends, NeedTwoJudgedLogs) {
  std::vector<BatchRow> rows = dated();
  EXPECT_NE(index_trends(rows), "");
  rows[0].verdict = rows[1].verdict = "unusable";
  EXPECT_EQ(index_trends(rows), "");
  EXPECT_EQ(index_trends({}), "");
}

TEST(IndexTrends, AreOrderedByStartTimeOnlyIfAllLogsHaveADate) {
  std::vector<BatchRow> rows = dated();
  EXPECT_TRUE(has(index_trends(rows), "in the order of their start"));
  std::vector<BatchRow> sorted = {rows[1], rows[2], rows[0]};
  EXPECT_EQ(index_trends(rows), index_trends(sorted));
  rows[2].start_s = sorted[1].start_s = 0.0;
  EXPECT_TRUE(has(index_trends(rows), "in the order of names"));
  EXPECT_NE(index_trends(rows), index_trends(sorted));
}

TEST(IndexTrends, FoldersAreComparedIfThereAreSeveral) {
  std::vector<BatchRow> rows = dated();
  EXPECT_TRUE(has(index_trends(rows), "residual by folder"));
  rows[2].log = "a/3.csv";
  EXPECT_FALSE(has(index_trends(rows), "residual by folder"));
}

TEST(IndexTrends, ParametersNearZeroOrInOneLogOnlyAreLeftOut) {
  std::vector<BatchRow> rows = dated();
  for (BatchRow& one : rows) one.parameters = {{"m1", 2.0, 0.1, ""}, {"o1", 0.1, 0.1, ""}};
  rows[0].parameters.push_back({"fv1", 4.0, 0.1, ""});
  const std::string page = index_trends(rows);
  EXPECT_TRUE(has(page, "% from median"));
  EXPECT_TRUE(has(page, "m1"));
  EXPECT_FALSE(has(page, "o1"));
  EXPECT_FALSE(has(page, "fv1"));
}

TEST(IndexTrends, PointsThatManyLogsShareKeepThePeaks) {
  std::vector<BatchRow> flat, peak;
  for (int i = 0; i < 1000; ++i) flat.push_back(row("a/" + std::to_string(1000 + i) + ".csv", 0.0, 1.0));
  peak = flat;
  peak[501].residual_rms[0] = 100.0;
  EXPECT_LT(index_trends(flat).size(), 40000u);
  EXPECT_NE(index_trends(peak), index_trends(flat));
}

TEST(IndexThumbnail, HasABarPerFaultAndIsEmptyForALogWithoutDuration) {
  BatchRow one = row("a.csv", 0.0, 1.0);
  EXPECT_FALSE(has(index_thumbnail(one), "<rect"));
  one.faults = {{{FaultKind::locked, 2_joint}, 2.5, 5.0, 7.5, 0.9}};
  EXPECT_TRUE(has(index_thumbnail(one),
                  "<rect x=\"40.0\" y=\"7\" width=\"40.0\" height=\"4\"/>"
                  "<rect class=\"f\" x=\"80.0\" y=\"7\" width=\"40.0\" height=\"4\"/>"))
      << index_thumbnail(one);
  one.end_s = one.start_s;
  EXPECT_EQ(index_thumbnail(one), "");
}

}  // namespace
}  // namespace faultline
