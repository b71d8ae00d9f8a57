// SPDX-License-Identifier: MIT
// How far the functions are from the true values, measured in units in the last place against the C library's
// in long double, whose 64 bits show thousandths of one.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/random.hpp"

namespace faultline::elementary {
namespace {

using Long = long double;
using One = double (*)(double);
using OneLong = Long (*)(Long);
using Two = double (*)(double, double);
using TwoLong = Long (*)(Long, Long);

constexpr int kArguments = 100000;
constexpr double kRounded = 0.52;    // correct up to the rounding of all but a few in a hundred
constexpr double kSubnormal = 0.76;  // a result that is rounded once more

double ulps_off(double got, Long truth) {
  const auto rounded = static_cast<double>(truth);
  if (std::isnan(got) || std::isinf(got) || std::isinf(rounded) || truth == 0.0L)
    return got == rounded || (std::isnan(got) && std::isnan(rounded))
               ? 0.0
               : std::numeric_limits<double>::infinity();
  int exponent = 0;
  std::frexp(truth, &exponent);
  return static_cast<double>(std::abs(got - truth) / std::ldexp(1.0L, std::max(exponent - 53, -1074)));
}

struct Range {
  double low, high;
};

double worst(One f, OneLong truth, Range range) {
  Random random(7);
  double most = 0.0;
  for (int i = 0; i < kArguments; ++i) {
    const double x = range.low + (range.high - range.low) * random.uniform();
    most = std::max(most, ulps_off(f(x), truth(x)));
  }
  return most;
}

/// Numbers of all sizes, from subnormal to the largest, of both signs.
double of_any_size(Random& random) {
  const double mantissa = 1.0 + random.uniform();
  const double size = std::ldexp(mantissa, static_cast<int>(2098.0 * random.uniform()) - 1074);
  return random.uniform() < 0.5 ? size : -size;
}

double worst_of_any_size(One f, OneLong truth) {
  Random random(8);
  double most = 0.0;
  for (int i = 0; i < kArguments; ++i) {
    const double x = of_any_size(random);
    most = std::max(most, ulps_off(f(x), truth(x)));
  }
  return most;
}

double worst_of_two(Two f, TwoLong truth, Range first, Range second) {
  Random random(9);
  double most = 0.0;
  for (int i = 0; i < kArguments; ++i) {
    const double x = first.low + (first.high - first.low) * random.uniform();
    const double y = second.low + (second.high - second.low) * random.uniform();
    most = std::max(most, ulps_off(f(x, y), truth(x, y)));
  }
  return most;
}

double worst_of_two_of_any_size(Two f, TwoLong truth) {
  Random random(10);
  double most = 0.0;
  for (int i = 0; i < kArguments; ++i) {
    const double x = of_any_size(random), y = of_any_size(random);
    most = std::max(most, ulps_off(f(x, y), truth(x, y)));
  }
  return most;
}

TEST(ElementaryAccuracy, ExpIsAccurate) {
  EXPECT_LT(worst(exp, expl, {-1.0, 1.0}), kRounded);
  EXPECT_LT(worst(exp, expl, {-708.0, 709.78}), kRounded);
  EXPECT_LT(worst(exp, expl, {-745.2, -708.0}), kSubnormal);
  EXPECT_LT(worst_of_any_size(exp, expl), kSubnormal);
}

TEST(ElementaryAccuracy, LogarithmsAreAccurate) {
  EXPECT_LT(worst(log, logl, {0.5, 2.0}), kRounded);
  EXPECT_LT(worst(log, logl, {0.99, 1.01}), kRounded);
  EXPECT_LT(worst(log, logl, {0.0, 1e6}), kRounded);
  EXPECT_LT(worst_of_any_size(log, logl), kRounded);
  EXPECT_LT(worst(log10, log10l, {0.5, 2.0}), kRounded);
  EXPECT_LT(worst_of_any_size(log10, log10l), kRounded);
  EXPECT_LT(worst(log1p, log1pl, {-0.99, 3.0}), kRounded);
  EXPECT_LT(worst(log1p, log1pl, {-1e-4, 1e-4}), kRounded);
  EXPECT_LT(worst_of_any_size(log1p, log1pl), kRounded);
}

TEST(ElementaryAccuracy, SineAndCosineAreAccurate) {
  constexpr double kLimit = 0.9;
  for (const Range range : {Range{-0.8, 0.8}, {-7.0, 7.0}, {-1e5, 1e5}, {9e5, 1.1e6}, {1e6, 1e15}}) {
    EXPECT_LT(worst(sin, sinl, range), kLimit) << range.high;
    EXPECT_LT(worst(cos, cosl, range), kLimit) << range.high;
  }
  EXPECT_LT(worst_of_any_size(sin, sinl), kLimit);
  EXPECT_LT(worst_of_any_size(cos, cosl), kLimit);
}

TEST(ElementaryAccuracy, SineAndCosineNearMultiplesOfRightAnglesAreAccurate) {
  Random random(3);
  for (int i = 0; i < kArguments; ++i) {
    const double x = std::floor(1e6 * random.uniform()) * (std::numbers::pi / 2.0);
    ASSERT_LT(ulps_off(sin(x), sinl(x)), kRounded) << x;
    ASSERT_LT(ulps_off(cos(x), cosl(x)), kRounded) << x;
  }
}

TEST(ElementaryAccuracy, TanhIsAccurate) {
  constexpr double kLimit = 0.95;
  for (const Range range : {Range{-0.54, 0.54}, {-1.0, 1.0}, {0.53, 0.57}, {-25.0, 25.0}})
    EXPECT_LT(worst(tanh, tanhl, range), kLimit) << range.high;
  EXPECT_LT(worst_of_any_size(tanh, tanhl), kLimit);
}

TEST(ElementaryAccuracy, AsinhAtanAndErfcAreAccurate) {
  EXPECT_LT(worst(asinh, asinhl, {-1.0, 1.0}), kRounded);
  EXPECT_LT(worst(asinh, asinhl, {-1e3, 1e3}), kRounded);
  EXPECT_LT(worst_of_any_size(asinh, asinhl), kRounded);
  EXPECT_LT(worst(atan, atanl, {-1.1, 1.1}), kRounded);
  EXPECT_LT(worst(atan, atanl, {-50.0, 50.0}), kRounded);
  EXPECT_LT(worst_of_any_size(atan, atanl), kRounded);
  EXPECT_LT(worst(erfc, erfcl, {-7.0, 3.0}), kRounded);
  EXPECT_LT(worst(erfc, erfcl, {2.4, 26.5}), kRounded);
  EXPECT_LT(worst(erfc, erfcl, {26.5, 27.4}), kSubnormal);
}

TEST(ElementaryAccuracy, FunctionsOfTwoArgumentsAreAccurate) {
  EXPECT_LT(worst_of_two(pow, powl, {0.0, 10.0}, {-10.0, 10.0}), kRounded);
  EXPECT_LT(worst_of_two(pow, powl, {0.9, 1.1}, {-7000.0, 7000.0}), kSubnormal);
  EXPECT_LT(worst_of_two_of_any_size(pow, powl), kSubnormal);
  EXPECT_LT(worst_of_two(atan2, atan2l, {-3.0, 3.0}, {-3.0, 3.0}), kRounded);
  EXPECT_LT(worst_of_two_of_any_size(atan2, atan2l), kSubnormal);
  EXPECT_LT(worst_of_two(hypot, hypotl, {-3.0, 3.0}, {-3.0, 3.0}), 0.65);
  EXPECT_LT(worst_of_two_of_any_size(hypot, hypotl), 0.65);
}

}  // namespace
}  // namespace faultline::elementary
