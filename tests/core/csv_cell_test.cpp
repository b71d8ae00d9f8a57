// SPDX-License-Identifier: MIT
#include "lib/core/csv_cell.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace faultline {
namespace {

TEST(CsvCell, IsQuotedOnlyIfNecessary) {
  EXPECT_EQ(csv_cell("plain text"), "plain text");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"no\"\n"), "\"say \"\"no\"\"\n\"");
}

TEST(CsvCell, HoldsNoFormulaAndNoTerminalCommand) {
  EXPECT_EQ(csv_cell("=cmd|'/c calc'!A0"), "'=cmd|'/c calc'!A0");
  EXPECT_EQ(csv_cell("@SUM(A1)"), "'@SUM(A1)");
  EXPECT_EQ(csv_cell("-2+3+cmd|' '!A0"), "'-2+3+cmd|' '!A0");
  EXPECT_EQ(csv_cell("+run,1"), "\"'+run,1\"");
  EXPECT_EQ(csv_cell("a;=1+1"), "\"a;=1+1\"");
  EXPECT_EQ(csv_cell("a;b"), "a;b");
  EXPECT_EQ(csv_cell("\x1b[2Jrun.csv"), "?[2Jrun.csv");
}

TEST(CsvCell, NegativeNumbersStayNumbers) {
  EXPECT_EQ(csv_cell(std::string("-0.25")), "-0.25");
  EXPECT_EQ(csv_cell(std::string("+1e-3")), "+1e-3");
}

TEST(CsvCell, NumbersKeepEveryBitAndMissingNumbersAreEmpty) {
  EXPECT_EQ(csv_cell(0.1), "0.1");
  EXPECT_EQ(csv_cell(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(csv_cell(std::numeric_limits<double>::infinity()), "");
  EXPECT_EQ(csv_joint(2_joint), "2");
  EXPECT_EQ(csv_joint(Joint()), "");
}

}  // namespace
}  // namespace faultline
