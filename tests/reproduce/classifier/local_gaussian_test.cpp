// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"
#include "lib/reproduce/classifier/transition_posterior.hpp"

namespace faultline {
namespace {

TEST(LocalGaussian, FindsTheTrendAndAVarianceThatChangesAlongTheInput) {
  Random random(4);
  Eigen::MatrixXd inputs(2, 4000), outputs(1, 4000);
  for (int i = 0; i < 4000; ++i) {
    const double x = random.uniform(0.0, 1.0);
    inputs.col(i) << 1.0, x;
    outputs(0, i) = 3.0 - 2.0 * x + (x < 0.5 ? 0.01 : 1.0) * random.normal();
  }
  const LocalGaussian gaussian = fit_local_gaussian(inputs, outputs);
  EXPECT_NEAR(mean_at(gaussian, Eigen::Vector2d(1.0, 0.5))[0], 2.0, 0.1);
  EXPECT_LT(std::sqrt(covariance_at(gaussian, Eigen::Vector2d(1.0, 0.2))(0, 0)), 0.15);
  const double loud = std::sqrt(covariance_at(gaussian, Eigen::Vector2d(1.0, 0.8))(0, 0));
  EXPECT_GT(loud, 0.5);
  EXPECT_LT(loud, 1.6);
}

}  // namespace
}  // namespace faultline
