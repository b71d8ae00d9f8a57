// SPDX-License-Identifier: MIT
#include <cmath>

#include "lib/core/elementary/double_double.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/elementary/scaled_exp.hpp"

namespace faultline::elementary {
namespace {

constexpr DoubleDouble kTwoByRootPi{0x1.20dd750429b6dp+0, 0x1.1ae3a914fed80p-56};
constexpr double kSeries = 2.5;     // limit of the series, at which 80 of 106 bits are left
constexpr int kSeriesTerms = 60;    // for 2^-70 of erfc at kSeries
constexpr int kLevels = 60;         // of the continued fraction, for 2^-64 at kSeries
constexpr double kAllAbove = 27.3;  // erfc is zero

/// erf(x) = 2 / sqrt(pi) sum over n of (-1)^n x^(2n + 1) / (n! (2n + 1)).
DoubleDouble erf_by_series(double x) {
  const DoubleDouble minus_square = -product_of(x, x);
  DoubleDouble term{x}, sum{x};
  for (int n = 1; n <= kSeriesTerms; ++n) {
    term = term * minus_square / DoubleDouble{static_cast<double>(n)};
    sum = sum + term / DoubleDouble{2.0 * n + 1.0};
  }
  return sum * kTwoByRootPi;
}

/// erfc(x) = e^(-x^2) / sqrt(pi) / (x + (1/2) / (x + (2/2) / (x + (3/2) / ...))).
double erfc_by_fraction(double x) {
  DoubleDouble below{x};
  for (int k = kLevels; k > 0; --k) below = DoubleDouble{x} + DoubleDouble{0.5 * k} / below;
  const DoubleDouble square = product_of(x, x);
  const ScaledExp bell = scaled_exp(-square.high, -square.low);
  const DoubleDouble factor = sum_of_ordered(bell.high, bell.low) * kTwoByRootPi / below;
  return std::ldexp(factor.high, bell.power - 1);
}

}  // namespace

double erfc(double x) {
  constexpr double kTwoBelow = -6.0;
  if (x != x) return x;
  if (x > kAllAbove) return 0.0;
  if (x < kTwoBelow) return 2.0;
  if (x > kSeries) return erfc_by_fraction(x);
  if (x < -kSeries) return 2.0 - erfc_by_fraction(-x);
  return (DoubleDouble{1.0} + -erf_by_series(x)).high;
}

}  // namespace faultline::elementary
