// SPDX-License-Identifier: MIT
#include "lib/core/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace faultline {
namespace {

const std::vector<double> kFour{4.0, 1.0, 3.0, 2.0};
const std::vector<double> kFive{5.0, 1.0, 4.0, 2.0, 3.0};

TEST(Statistics, TheMedianOfAnEvenNumberIsTheUpperOfTheMiddleTwo) {
  EXPECT_EQ(upper_median(kFour), 3.0);
  EXPECT_EQ(upper_median(kFive), 3.0);
  EXPECT_EQ(upper_median({7.0}), 7.0);
}

TEST(Statistics, TheMedianInPlaceKeepsTheValues) {
  std::vector<double> values = kFour;
  EXPECT_EQ(upper_median_of(values), 3.0);
  EXPECT_TRUE(std::is_permutation(values.begin(), values.end(), kFour.begin()));
}

TEST(Statistics, QuantilesDifferInTheirRounding) {
  EXPECT_EQ(upper_quantile(kFour, 0.5), 3.0);
  EXPECT_EQ(lower_quantile(kFour, 0.5), 2.0);
  EXPECT_EQ(nearest_rank_quantile(kFour, 0.5), 2.0);
  EXPECT_EQ(upper_quantile(kFive, 0.7), 4.0);
  EXPECT_EQ(lower_quantile(kFive, 0.7), 3.0);
  EXPECT_EQ(nearest_rank_quantile(kFive, 0.7), 4.0);
  EXPECT_EQ(nearest_rank_quantile(kFive, 0.61), 4.0);
}

TEST(Statistics, QuantilesReachFromTheSmallestToTheLargestValue) {
  for (const auto quantile : {upper_quantile, lower_quantile, nearest_rank_quantile}) {
    EXPECT_EQ(quantile(kFive, 0.0), 1.0);
    EXPECT_EQ(quantile(kFive, 1.0), 5.0);
    EXPECT_EQ(quantile({7.0}, 0.9), 7.0);
  }
}

TEST(Statistics, StatisticsOfNoValuesAreNaN) {
  EXPECT_TRUE(std::isnan(upper_median({})));
  for (const auto quantile : {upper_quantile, lower_quantile, nearest_rank_quantile})
    EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

}  // namespace
}  // namespace faultline
