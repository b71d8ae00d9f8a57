// SPDX-License-Identifier: MIT
// Infinities, NaN, zeros and their signs, subnormal and huge arguments: as in C, Annex F.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "lib/core/elementary/elementary.hpp"

namespace faultline::elementary {
namespace {

using One = double (*)(double);

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();
constexpr double kMost = std::numeric_limits<double>::max();

/// The same number with the same sign, or both NaN.
void expect_same(double got, double expected, const char* what) {
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(got)) << what << ": " << got;
    return;
  }
  EXPECT_EQ(got, expected) << what;
  EXPECT_EQ(std::signbit(got), std::signbit(expected)) << what;
}

TEST(ElementaryLimits, OddFunctionsReturnSignedZerosAndTinyArguments) {
  const std::vector<One> odd{sin, tanh, asinh, atan, log1p};
  for (std::size_t k = 0; k < odd.size(); ++k)
    for (const double x : {0.0, -0.0, kLeast, -kLeast, 1e-310, -1e-310, 1e-200})
      expect_same(odd[k](x), x, std::to_string(k).c_str());
  expect_same(sin_cos(-0.0).sin, -0.0, "sin_cos");
}

TEST(ElementaryLimits, NaNStaysNaN) {
  for (const One f : std::vector<One>{exp, log, log1p, log10, sin, cos, tanh, asinh, atan, erfc})
    EXPECT_TRUE(std::isnan(f(kNaN)));
  for (const auto f : {pow, atan2, hypot}) {
    EXPECT_TRUE(std::isnan(f(kNaN, 2.0)));
    EXPECT_TRUE(std::isnan(f(2.0, kNaN)));
  }
}

TEST(ElementaryLimits, InfinitiesAndPolesGiveTheirLimits) {
  expect_same(exp(kInf), kInf, "exp");
  expect_same(exp(-kInf), 0.0, "exp");
  expect_same(exp(710.0), kInf, "exp overflows");
  expect_same(exp(-746.0), 0.0, "exp underflows");
  expect_same(exp(-0.0), 1.0, "exp");
  expect_same(log(kInf), kInf, "log");
  expect_same(log(0.0), -kInf, "log");
  expect_same(log(-0.0), -kInf, "log");
  expect_same(log(-1.0), kNaN, "log");
  expect_same(log(1.0), 0.0, "log");
  expect_same(log10(0.0), -kInf, "log10");
  expect_same(log10(-kInf), kNaN, "log10");
  expect_same(log1p(-1.0), -kInf, "log1p");
  expect_same(log1p(-1.5), kNaN, "log1p");
  expect_same(log1p(kInf), kInf, "log1p");
  expect_same(sin(kInf), kNaN, "sin");
  expect_same(cos(-kInf), kNaN, "cos");
  expect_same(cos(0.0), 1.0, "cos");
  expect_same(tanh(kInf), 1.0, "tanh");
  expect_same(tanh(-kInf), -1.0, "tanh");
  expect_same(asinh(-kInf), -kInf, "asinh");
  expect_same(erfc(kInf), 0.0, "erfc");
  expect_same(erfc(-kInf), 2.0, "erfc");
  expect_same(erfc(0.0), 1.0, "erfc");
}

TEST(ElementaryLimits, WholePowersOfTenHaveExactLogarithms) {
  for (int k = -300; k <= 300; ++k) {
    const double power = std::stod("1e" + std::to_string(k));
    EXPECT_EQ(log10(power), static_cast<double>(k)) << k;
  }
  for (int k = -22; k <= 22; ++k) EXPECT_EQ(pow(10.0, k), std::stod("1e" + std::to_string(k))) << k;
}

TEST(ElementaryLimits, PowFollowsTheCStandard) {
  struct Case {
    double x, y, power;
  };
  for (const Case& c : std::vector<Case>{
           {kNaN, 0.0, 1.0},    {1.0, kNaN, 1.0},      {-1.0, kInf, 1.0},      {-1.0, -kInf, 1.0},
           {0.5, kInf, 0.0},    {-0.5, -kInf, kInf},   {2.0, kInf, kInf},      {-2.0, -kInf, 0.0},
           {0.0, 3.0, 0.0},     {-0.0, 3.0, -0.0},     {-0.0, 2.0, 0.0},       {0.0, -3.0, kInf},
           {-0.0, -3.0, -kInf}, {-0.0, -2.0, kInf},    {-0.0, 0.5, 0.0},       {kInf, 2.0, kInf},
           {kInf, -2.0, 0.0},   {-kInf, 3.0, -kInf},   {-kInf, 2.0, kInf},     {-kInf, -3.0, -0.0},
           {-kInf, 0.5, kInf},  {-2.0, 3.0, -8.0},     {-2.0, 4.0, 16.0},      {-2.0, 0.5, kNaN},
           {0.0, -kInf, kInf},  {-kInf, kInf, kInf},   {10.0, 400.0, kInf},    {-10.0, 401.0, -kInf},
           {10.0, -400.0, 0.0}, {-10.0, -401.0, -0.0}, {2.0, -1074.0, kLeast}, {2.0, 0.5, std::sqrt(2.0)},
           {kMost, 1.0, kMost}, {kLeast, 1.0, kLeast}, {2.0, kMost, kInf}})
    expect_same(pow(c.x, c.y), c.power, (std::to_string(c.x) + "^" + std::to_string(c.y)).c_str());
}

TEST(ElementaryLimits, Atan2AndHypotHandleZerosInfinitiesAndExtremes) {
  constexpr double kPi = 0x1.921fb54442d18p+1;
  expect_same(atan(kInf), kPi / 2.0, "atan");
  expect_same(atan2(0.0, 1.0), 0.0, "atan2");
  expect_same(atan2(-0.0, 1.0), -0.0, "atan2");
  expect_same(atan2(0.0, -1.0), kPi, "atan2");
  expect_same(atan2(-0.0, -0.0), -kPi, "atan2");
  expect_same(atan2(1.0, 0.0), kPi / 2.0, "atan2");
  expect_same(atan2(-1.0, -0.0), -kPi / 2.0, "atan2");
  expect_same(atan2(kInf, kInf), kPi / 4.0, "atan2");
  expect_same(atan2(-kInf, -kInf), -0.75 * kPi, "atan2");
  expect_same(atan2(1.0, -kInf), kPi, "atan2");
  expect_same(atan2(-kInf, 1.0), -kPi / 2.0, "atan2");
  expect_same(atan2(kMost, kMost), kPi / 4.0, "atan2");
  expect_same(atan2(kLeast, kLeast), kPi / 4.0, "atan2");
  expect_same(hypot(-kInf, kNaN), kInf, "hypot");
  expect_same(hypot(-3.0, 4.0), 5.0, "hypot");
  expect_same(hypot(-0.0, 0.0), 0.0, "hypot");
  expect_same(hypot(kMost, kMost), kInf, "hypot");
  expect_same(hypot(kLeast, 0.0), kLeast, "hypot");
}

/// Values known to many digits: what 2^60 and more turns leave.
TEST(ElementaryLimits, SineAndCosineOfHugeAnglesAreAccurate) {
  EXPECT_DOUBLE_EQ(sin(1e22), -0.8522008497671888);
  EXPECT_DOUBLE_EQ(cos(1e22), 0.523214785395139);
  EXPECT_DOUBLE_EQ(sin(1e300), -0.8178819121159085);
  EXPECT_DOUBLE_EQ(cos(1e300), -0.5753861119575491);
  EXPECT_DOUBLE_EQ(sin(kMost), 0.004961954789184062);
  EXPECT_DOUBLE_EQ(cos(kMost), -0.9999876894265599);
  // The double nearest to a whole number of right angles, relative to its size (Muller et al. 2018).
  EXPECT_EQ(cos(0x1.6ac5b262ca1ffp+849), -0x1.14ae72e6ba22fp-61);
}

TEST(ElementaryLimits, SinCosGivesTheSameBitsAsSinAndCos) {
  for (double x = -1e4; x < 1e4; x += 0.7137) {
    const auto [s, c] = sin_cos(x);
    ASSERT_EQ(s, sin(x));
    ASSERT_EQ(c, cos(x));
  }
}

}  // namespace
}  // namespace faultline::elementary
