// SPDX-License-Identifier: MIT
#include "lib/reproduce/filter/follower.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

TEST(RepeatedCodes, ReadingsThatDifferCountInFull) {
  RepeatedCodes codes;
  for (int k = 0; k < 100; ++k) {
    codes.take(0, 0.1 * k);
    EXPECT_EQ(codes.noise_factor(0), 1.0);
  }
}

TEST(RepeatedCodes, OneOrTwoCodesForLongCountAsOneReading) {
  RepeatedCodes one, two;
  for (int k = 0; k < 109; ++k) {
    one.take(0, 0.5);
    two.take(0, k % 3 == 0 ? 0.5 : 0.6);
  }
  EXPECT_NEAR(one.noise_factor(0), std::sqrt(101.0), 0.1);
  EXPECT_NEAR(two.noise_factor(0), std::sqrt(100.0), 0.1);
  EXPECT_EQ(one.noise_factor(1), 1.0) << "another joint";
}

TEST(RepeatedCodes, AFewAlikeAndAThirdCodeCountInFull) {
  RepeatedCodes codes;
  for (int k = 0; k < 8; ++k) codes.take(0, 0.5);
  EXPECT_EQ(codes.noise_factor(0), 1.0);
  for (int k = 0; k < 50; ++k) codes.take(0, 0.5);
  EXPECT_GT(codes.noise_factor(0), 5.0);
  codes.take(0, 0.7);
  codes.take(0, 0.9);
  EXPECT_EQ(codes.noise_factor(0), 1.0);
  codes.take(0, std::nan(""));
  EXPECT_EQ(codes.noise_factor(0), 1.0);
}

}  // namespace
}  // namespace faultline
