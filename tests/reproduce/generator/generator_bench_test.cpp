// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/reproduce/generator/generator_measurements.hpp"

namespace faultline {
namespace {

const HalfRanges kRanges{Eigen::Vector3d(2.0, 2.0, 0.2), Eigen::Vector3d(4.0, 4.0, 4.0), {}};

TEST(WorstSamples, HaveTheShareOfTheErrorOfOneBadSample) {
  Eigen::MatrixXd error = Eigen::MatrixXd::Zero(6, 20);
  error.row(3).setConstant(0.004);  // 1e-3 of the half range
  error(3, 7) = 0.4;
  const WorstSamples worst = worst_samples(error, kRanges, 0.05);
  EXPECT_NEAR(worst.share_of_error, 1e-2 / (1e-2 + 19e-6), 1e-12);
  EXPECT_NEAR(worst.mse_of_others, 1e-6 / 6.0, 1e-18);
}

TEST(WorstSamples, HaveNoShareOfAnErrorThatIsNotFinite) {
  Eigen::MatrixXd error = Eigen::MatrixXd::Ones(6, 20);
  error(0, 0) = std::nan("");
  EXPECT_TRUE(std::isnan(worst_samples(error, kRanges, 0.05).share_of_error));
}

TEST(WorstSamples, AreAsManyAsTheSamplesWithTheStartOfAMove) {
  // One sample of 73 ms in each move of 1.2 to 1.8 s and rest of up to 0.4 s.
  EXPECT_NEAR(share_with_a_start(), 0.073 / (1.5 + 0.2), 1e-12);
}

}  // namespace
}  // namespace faultline
