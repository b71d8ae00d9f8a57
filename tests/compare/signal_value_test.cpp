// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lib/compare/motion_pair.hpp"
#include "lib/compare/run_signals.hpp"

namespace faultline {
namespace {

TEST(ValueBetween, IsExactOnACubicAndMissingOutsideAndInGaps) {
  std::vector<double> time, values;
  for (int i = 0; i < 20; ++i) {
    time.push_back(0.1 * i + (i >= 10 ? 5.0 : 0.0));
    const double t = time.back();
    values.push_back(2.0 - t + 3.0 * t * t - 0.5 * t * t * t);
  }
  EXPECT_NEAR(value_between(time, values, 0.437, 0.3).value,
              2.0 - 0.437 + 3.0 * 0.437 * 0.437 - 0.5 * std::pow(0.437, 3), 1e-12);
  EXPECT_EQ(value_between(time, values, time[4], 0.3).value, values[4]);
  EXPECT_EQ(value_between(time, values, time[4], 0.3).error, 0.0);
  EXPECT_TRUE(std::isnan(value_between(time, values, 3.0, 0.3).value));
  EXPECT_TRUE(std::isnan(value_between(time, values, -0.1, 0.3).value));
  EXPECT_TRUE(std::isnan(value_between(time, values, 99.0, 0.3).value));
  values[4] = std::nan("");
  EXPECT_TRUE(std::isnan(value_between(time, values, 0.43, 0.3).value));
}

TEST(NoiseOf, IsIndependentOfTheMotionAndOfAFewJumps) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 1e-3);
  std::vector<double> values;
  for (int i = 0; i < 5000; ++i)
    values.push_back(std::sin(0.02 * i) + (i > 3000 ? 0.5 : 0.0) + (i % 100 == 0 ? 0.2 : 0.0) +
                     noise(random));
  EXPECT_NEAR(noise_of(values), 1e-3, 1e-4);
  for (double& v : values) v = std::round(v / 0.01) * 0.01;
  EXPECT_GE(noise_of(values), 0.01 / std::sqrt(12.0) * 0.999) << "coarse codes have the noise of their step";
  EXPECT_EQ(noise_of({1.0, 1.0, 1.0, 1.0, 1.0}), 0.0);
  EXPECT_EQ(noise_of({}), 0.0);
}

TEST(WarpedPlaces, FollowTheOtherMotionAndNeverDecrease) {
  MotionSamples a, b;
  for (int i = 0; i <= 100; ++i) a.push_back({std::sin(0.06 * i)});
  for (int i = 0; i <= 200; ++i) b.push_back({std::sin(0.03 * i)});
  const std::vector<double> places = warped_places(a, b);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(places[i], 2.0 * static_cast<double>(i), 3.0);
    EXPECT_GE(places[i], i > 0 ? places[i - 1] : 0.0);
  }
  const std::vector<double> same = warped_places(a, a);
  for (std::size_t i = 0; i < same.size(); ++i) EXPECT_EQ(same[i], static_cast<double>(i));
}

}  // namespace
}  // namespace faultline
