// SPDX-License-Identifier: MIT
#include "lib/core/csv_cell.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace faultline {
namespace {

TEST(CsvCell, IsQuotedOnlyWhereItMustBe) {
  EXPECT_EQ(csv_cell("plain text"), "plain text");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"no\"\n"), "\"say \"\"no\"\"\n\"");
}

TEST(CsvCell, NumbersKeepEveryBitAndNoNumberIsEmpty) {
  EXPECT_EQ(csv_cell(0.1), "0.1");
  EXPECT_EQ(csv_cell(1.0 / 3.0), "0.3333333333333333");
  EXPECT_EQ(csv_cell(std::numeric_limits<double>::infinity()), "");
  EXPECT_EQ(csv_joint(2), "2");
  EXPECT_EQ(csv_joint(0), "");
}

}  // namespace
}  // namespace faultline
