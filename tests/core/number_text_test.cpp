// SPDX-License-Identifier: MIT
#include "lib/core/number_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

TEST(NumberText, TimesHaveTheDigitsOfTheSamplePeriod) {
  EXPECT_EQ(time_text(1.23456, 0.073), "1.235 s");
  EXPECT_EQ(time_text(1.23456, 0.0001), "1.2346 s");
  EXPECT_EQ(time_text(1.23456, std::nan("")), "1.235 s");
  EXPECT_EQ(time_text(std::nan(""), 0.1), "unknown");
}

TEST(NumberText, ValuesHaveThreeDigitsButStayWholeBelowTenMillion) {
  EXPECT_EQ(value_text(0.0012345), "0.00123");
  EXPECT_EQ(value_text(12345.6), "12346");
  EXPECT_EQ(value_text(2e7), "2e+07");
  EXPECT_EQ(value_text(std::nan("")), "-");
}

TEST(NumberText, DigitsPercentagesAndSecondsAreFormatted) {
  EXPECT_EQ(digits_text(0.123456789, 5), "0.12346");
  EXPECT_EQ(percent_text(0.956), "96 %");
  EXPECT_EQ(seconds_text(4.21), "4.210 s");
}

TEST(NumberText, TimeAxesOfALateStartBeginAtItsWholeSecond) {
  EXPECT_EQ(time_zero(12.5), 0.0);
  EXPECT_EQ(time_zero(1.7e9 + 0.5), 1.7e9);
}

}  // namespace
}  // namespace faultline
