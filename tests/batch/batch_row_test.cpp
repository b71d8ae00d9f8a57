// SPDX-License-Identifier: MIT
#include "lib/batch/batch_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

BatchRow faulty_row() {
  BatchRow row;
  row.log = "runs/a \"b\", c.csv";
  row.sha256 = "00ff";
  row.result = "runs_a-123456789abc";
  row.verdict = "faulty";
  row.reason = "2 faults found";
  row.format = "csv";
  row.rows = 1000;
  row.rows_used = 998;
  row.start_s = 1763710000.073;
  row.end_s = 1763710020.0 + 1.0 / 3.0;
  row.sample_period_s = 0.02;
  row.joints = 3;
  row.warnings = 1;
  row.severe = 2;
  row.score = 3.125;
  row.residual_rms = {1.0 / 3.0, kNan, 2.5};
  row.residual_peak = {4.0, kNan, 9.0};
  row.faults = {{{FaultKind::locked, 2_joint}, 0.5, 0.625, kNan, 0.75},
                {{FaultKind::unknown, Joint()}, 4.0, kNan, 5.0, 0.5}};
  row.condition = {{"friction_1", 12.5, 1.5, ""}};
  row.parameters = {{"m1", 2.5, 0.125, ""}, {"fc1", -0.25, kNan, ""}};
  return row;
}

int cells(const std::string& line) { return 1 + static_cast<int>(std::count(line.begin(), line.end(), ',')); }

TEST(BatchRow, IsReadBackFromItsJsonLine) {
  const std::string line = to_json_line(faulty_row());
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
  const BatchRow read = row_from_json(line);
  EXPECT_EQ(to_json_line(read), line);
  EXPECT_EQ(read.log, faulty_row().log);
  EXPECT_EQ(read.result, faulty_row().result);
  EXPECT_EQ(read.end_s, faulty_row().end_s);
  EXPECT_EQ(read.score, 3.125);
  EXPECT_EQ(read.faults[1].label, (FaultLabel{FaultKind::unknown, Joint()}));
  EXPECT_TRUE(std::isnan(read.residual_rms[1]));
  ASSERT_EQ(read.condition.size(), 1u);
  EXPECT_EQ(read.condition[0].name, "friction_1");
  EXPECT_EQ(read.condition[0].std, 1.5);
  EXPECT_EQ(read.parameters[0].name, "m1");
  EXPECT_EQ(read.parameters[0].value, 2.5);
}

TEST(BatchRow, ItsCsvLineHoldsNoFormulaAndNoTerminalCommand) {
  BatchRow row = faulty_row();
  row.log = "=cmd|'/c calc'!A0\x1b[2J.csv";
  row.reason = "@SUM(1)\x1b]0;x\x07";
  const std::string line = to_csv_line(row);
  EXPECT_TRUE(line.starts_with("'=cmd|'/c calc'!A0?[2J.csv,")) << line;
  EXPECT_NE(line.find(",'@SUM(1)?]0;x?,"), std::string::npos) << line;
}

TEST(BatchRow, AnUnusableLogIsReadBackFromItsJsonLine) {
  const BatchRow row =
      unusable_row("runs/a.csv", "/data/runs/a.csv", Error(ErrorCode::input, "/data/runs/a.csv", "is empty"));
  const BatchRow read = row_from_json(to_json_line(row));
  EXPECT_EQ(to_json_line(read), to_json_line(row));
  EXPECT_EQ(read.verdict, "unusable");
  EXPECT_TRUE(read.result.empty());
  EXPECT_TRUE(std::isnan(read.start_s));
}

TEST(BatchRow, TheReasonHoldsThePlaceInTheFileAndNoFolder) {
  const Error inside(ErrorCode::input, "/data/runs/a.csv, row 17", "expected a number");
  EXPECT_EQ(unusable_row("runs/a.csv", "/data/runs/a.csv", inside).reason, "row 17: expected a number");
  const Error whole(ErrorCode::internal, "/data/runs/a.csv", "defect");
  EXPECT_EQ(unusable_row("runs/a.csv", "/data/runs/a.csv", whole).reason, "defect");
  EXPECT_EQ(unusable_row("runs/a.csv", "/data/runs/a.csv", whole).verdict, "failed");
}

TEST(BatchRow, TheCsvLineHasOneCellPerColumnAndQuotesNames) {
  BatchRow row = faulty_row();
  const std::string line = to_csv_line(row);
  EXPECT_TRUE(
      line.starts_with("\"runs/a \"\"b\"\", c.csv\",faulty,2,locked,2,0.5,,0.625,0.75,"
                       "locked 2 @0.5;unknown @4,2.5,1000,998,"))
      << line;
  row.log = "plain.csv";
  EXPECT_EQ(cells(to_csv_line(row)), cells(batch_csv_header()));
  row.faults.clear();
  EXPECT_EQ(cells(to_csv_line(row)), cells(batch_csv_header()));
}

TEST(BatchRow, ItsResidualLevelIsTheLargestMeasuredResidual) {
  EXPECT_EQ(residual_level(faulty_row()), 2.5);
  EXPECT_TRUE(std::isnan(residual_level(BatchRow{})));
}

TEST(BatchRow, ItsStatusFollowsFromItsVerdictAndItsFolderFromItsLog) {
  BatchRow row;
  row.verdict = "healthy";
  EXPECT_EQ(status_of(row), 0);
  row.verdict = "inconclusive";
  EXPECT_EQ(status_of(row), 1) << "not healthy";
  row.verdict = "unusable";
  EXPECT_EQ(status_of(row), 3);
  row.verdict = "failed";
  EXPECT_EQ(status_of(row), 4);
  EXPECT_EQ(status_of(faulty_row()), 1);
  row.log = "runs/day_1/a.csv";
  EXPECT_EQ(folder_of(row), "runs/day_1");
  row.log = "a.csv";
  EXPECT_EQ(folder_of(row), "");
}

}  // namespace
}  // namespace faultline
