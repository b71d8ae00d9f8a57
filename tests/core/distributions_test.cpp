// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lib/core/statistics.hpp"

namespace faultline {
namespace {

TEST(Distributions, TailsEqualPublishedTables) {
  const double chi[] = {3.841459, 5.991465, 7.814728, 9.487729, 11.070498};
  const double student[] = {12.706205, 4.302653, 3.182446, 2.776445, 2.570582};
  for (int d = 1; d <= 5; ++d) {
    EXPECT_NEAR(chi_square_tail(chi[d - 1], d), 0.05, 1e-6) << d;
    EXPECT_NEAR(student_tail(-student[d - 1], d), 0.05, 1e-6) << d;
  }
  EXPECT_NEAR(normal_tail(1.959964), 0.05, 1e-6);
}

TEST(Distributions, TailsFarOutAreSmallAndNotNegative) {
  EXPECT_LT(chi_square_tail(1e4, 7), 1e-100);
  EXPECT_GE(student_tail(1e9, 4), 0.0);
  EXPECT_DOUBLE_EQ(chi_square_tail(0.0, 3), 1.0);
  EXPECT_DOUBLE_EQ(student_tail(0.0, 4), 1.0);
}

}  // namespace
}  // namespace faultline
