// SPDX-License-Identifier: MIT
#include "lib/balance/ripples.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr double kRange = 2.0, kKernel_s = 0.005;

/// Rows of a joint that moves to and fro, with a ripple of this rate in its residual.
RippleRows rippled(double rate, double amplitude) {
  Random random(5);
  RippleRows out;
  for (int k = 0; k < 600; ++k) {
    const double t = 0.02 * k, q = std::sin(1.3 * t);
    out.add(q, 1.3 * std::cos(1.3 * t), 5.0 * std::sin(2.1 * t),
            amplitude * std::sin(rate * q + 0.4) + 0.1 * random.normal());
  }
  return out;
}

TEST(Ripples, TheRateIsRefinedBetweenTheSteps) {
  const RippleBounds bounds{.least_explained = 0.5, .least_waves = 20.0, .refinements = 12};
  EXPECT_NEAR(strongest_ripple(rippled(41.37, 0.5), kKernel_s, kRange, bounds).value_or(0.0), 41.37, 0.02);
}

TEST(Ripples, TheRateIsFoundToTheNearestStep) {
  for (const RippleForm form : {RippleForm::constant, RippleForm::constant_and_by_torque}) {
    const auto found = strongest_ripple(rippled(41.37, 0.5), kKernel_s, kRange, {form, 0.5, 20.0});
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, 41.37, 0.5 / kRange);
  }
}

TEST(Ripples, NoiseHasNoRipple) {
  EXPECT_FALSE(strongest_ripple(rippled(41.37, 0.0), kKernel_s, kRange, {RippleForm::constant, 0.5, 20.0}));
}

TEST(Ripples, ARippleWithTooFewWavesIsNotSearched) {
  const RippleRows slow = rippled(4.0, 0.5);
  EXPECT_FALSE(strongest_ripple(slow, kKernel_s, kRange, {RippleForm::constant, 0.5, 20.0}));
  EXPECT_TRUE(strongest_ripple(slow, kKernel_s, kRange, {RippleForm::constant, 0.5, 6.0}));
}

TEST(Ripples, AJointAtRestHasNoRipple) {
  EXPECT_FALSE(strongest_ripple(rippled(41.37, 0.5), kKernel_s, 0.0, {RippleForm::constant, 0.5, 20.0}));
}

}  // namespace
}  // namespace faultline
