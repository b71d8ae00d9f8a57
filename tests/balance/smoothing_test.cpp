// SPDX-License-Identifier: MIT
#include "lib/balance/smoothing.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace faultline {
namespace {

Eigen::VectorXd sine(int rows, double period_s, double frequency_hz) {
  return Eigen::VectorXd::NullaryExpr(rows, [=](Eigen::Index k) {
    return std::sin(2.0 * M_PI * frequency_hz * period_s * static_cast<double>(k));
  });
}

TEST(Smoothing, TheKernelHasSumOneAndTheGainOfAGaussian) {
  constexpr double kSigma = 0.012, kPeriod = 0.001, kFrequency = 8.0;
  const Eigen::VectorXd kernel = gaussian_kernel(kSigma, kPeriod);
  EXPECT_NEAR(kernel.sum(), 1.0, 1e-14);
  const Eigen::VectorXd x = sine(1000, kPeriod, kFrequency), y = smooth(x, kernel);
  const double w = 2.0 * M_PI * kFrequency * kSigma, gain = std::exp(-0.5 * w * w);
  EXPECT_LT((y - gain * x).segment(100, 800).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Smoothing, SmoothingAtSomeRowsEqualsSmoothingOfAllRows) {
  const Eigen::VectorXd kernel = gaussian_kernel(0.01, 0.001), x = sine(500, 0.001, 3.0);
  const Eigen::MatrixXd all = smooth(x, kernel), some = smooth_at(x, kernel, 50, 10, 40);
  for (int m = 0; m < 40; ++m) EXPECT_EQ(some(m, 0), all(50 + 10 * m, 0));
}

TEST(Smoothing, TheTwoSidedExponentialKeepsAConstantAndIsSymmetric) {
  EXPECT_LT((two_sided_exponential(Eigen::VectorXd::Ones(50), 0.7) - Eigen::VectorXd::Ones(50)).norm(),
            1e-12);
  Eigen::VectorXd impulse = Eigen::VectorXd::Zero(101);
  impulse[50] = 1.0;
  const Eigen::VectorXd y = two_sided_exponential(impulse, 0.7);
  EXPECT_LT((y - y.reverse()).norm(), 1e-12);
  EXPECT_NEAR(y[53] / y[50], std::pow(0.7, 3), 1e-12);
}

TEST(Smoothing, TheGradientOfAParabolaIsItsSlope) {
  const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(
      20, [](Eigen::Index k) { return 0.5 * 0.01 * 0.01 * static_cast<double>(k * k); });
  const Eigen::VectorXd slope = gradient(x, 0.01);
  for (int k = 1; k < 19; ++k) EXPECT_NEAR(slope[k], 0.01 * k, 1e-12);
}

}  // namespace
TEST(Smoothing, TheTabulatedNormalDistributionIsAccurate) {
  for (double x = -7.0; x <= 7.0; x += 0.00173)
    EXPECT_NEAR(normal_cdf(x), 0.5 * std::erfc(-x / std::sqrt(2.0)), 2e-9) << x;
  EXPECT_EQ(normal_cdf(-6.0), 0.0);
  EXPECT_EQ(normal_cdf(6.0), 1.0);
  EXPECT_NEAR(normal_cdf(std::nextafter(6.0, 0.0)), 1.0, 2e-9);
  EXPECT_TRUE(std::isnan(normal_cdf(NAN)));
}

}  // namespace faultline
