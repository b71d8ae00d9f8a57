// SPDX-License-Identifier: MIT
#include "lib/identify/verdict/residual_pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

/// 60 s of windows of a joint that swings; what is left is `left` of position, speed and time, and noise.
JointFit swinging(const std::function<double(double, double, double)>& left, double noise) {
  Random random(2);
  JointFit fit;
  fit.window_s = 0.04;
  for (int k = 0; k < 3000; ++k) {
    const double t = 0.02 * k, q = std::sin(0.7 * t) + 0.6 * std::sin(1.9 * t);
    const double dq = 0.7 * std::cos(0.7 * t) + 1.14 * std::cos(1.9 * t);
    fit.log.push_back(0);
    fit.time_s.push_back(t);
    fit.q.push_back(q);
    fit.dq.push_back(dq);
    fit.modelled.push_back(random.normal());
    fit.measured.push_back(fit.modelled.back() + left(q, dq, t) + noise * random.normal());
    fit.friction.push_back(0.0);
    fit.moving.push_back(true);
  }
  return fit;
}

TEST(ResidualPattern, WhiteNoiseHasNoPattern) {
  const ResidualPattern p = residual_pattern(swinging([](double, double, double) { return 0.0; }, 1.0));
  EXPECT_LT(p.position, 0.01);
  EXPECT_LT(p.speed, 0.01);
  EXPECT_LT(p.torque, 0.01);
  EXPECT_LT(p.previous, 0.01);
}

TEST(ResidualPattern, ARippleOfThePositionIsDistinguishedFromAPatternOfTheSpeed) {
  const ResidualPattern ripple =
      residual_pattern(swinging([](double q, double, double) { return std::sin(6.0 * q); }, 0.2));
  EXPECT_GT(ripple.position, 0.7);
  EXPECT_LT(ripple.speed, 0.3);
  const ResidualPattern stribeck = residual_pattern(
      swinging([](double, double dq, double) { return std::exp(-4.0 * std::abs(dq)); }, 0.05));
  EXPECT_GT(stribeck.speed, 0.7);
  EXPECT_LT(stribeck.position, stribeck.speed);
}

TEST(ResidualPattern, AnOscillationIsAPeakOfTheSpectrumWithItsSize) {
  const ResidualPattern p =
      residual_pattern(swinging([](double, double, double t) { return std::sin(6.2832 * 5.0 * t); }, 0.1));
  const auto peak = std::max_element(p.spectrum.begin(), p.spectrum.end());
  EXPECT_NEAR(p.spectrum_hz[static_cast<std::size_t>(peak - p.spectrum.begin())], 5.0, 0.2);
  double power = 0.0;
  for (const double rms : p.spectrum) power += rms * rms;
  EXPECT_NEAR(std::sqrt(power), std::sqrt(0.5 + 0.01), 0.05);
}

TEST(ResidualPattern, TooFewWindowsGiveNoPattern) {
  JointFit fit = swinging([](double, double, double) { return 0.0; }, 1.0);
  fit.moving.assign(fit.moving.size(), false);
  EXPECT_TRUE(std::isnan(residual_pattern(fit).position));
  EXPECT_TRUE(std::isnan(residual_pattern(fit).previous));
  EXPECT_TRUE(residual_pattern({}).spectrum.empty());
}

}  // namespace
}  // namespace faultline
