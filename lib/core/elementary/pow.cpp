// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/elementary/scaled_exp.hpp"
#include "lib/core/elementary/scaled_log.hpp"

namespace faultline::elementary {
namespace {

constexpr double kPowInfinity = std::numeric_limits<double>::infinity();
constexpr double kPowAllAbove = 710.0, kPowAllBelow = -746.0;  // exponents of e: infinite, zero

bool is_whole(double y) { return std::trunc(y) == y; }
bool is_odd(double y) { return is_whole(y) && !is_whole(0.5 * y); }

/// Returns x^y for x above zero and finite, y finite.
double power_of_positive(double x, double y) {
  const DoubleDouble log = precise_log(x);
  const double about = y * log.high;
  if (about > kPowAllAbove) return kPowInfinity;
  if (about < kPowAllBelow) return 0.0;
  const DoubleDouble product = product_of(y, log.high);
  const DoubleDouble exponent = sum_of_ordered(product.high, product.low + y * log.low);
  return scaled_exp(exponent.high, exponent.low).value();
}

/// Returns x^y if x or y is infinite or x is zero; x is not negative.
double power_at_limits(double x, double y) {
  if (std::isinf(y)) {
    if (x == 1.0) return 1.0;
    return (x > 1.0) == (y > 0.0) ? kPowInfinity : 0.0;
  }
  return (x == 0.0) == (y > 0.0) ? 0.0 : kPowInfinity;
}

}  // namespace

double pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (x != x || y != y) return x + y;
  const double a = std::abs(x);
  if (a == 0.0 || std::isinf(a) || std::isinf(y)) {
    const double size = power_at_limits(a, y);
    return std::signbit(x) && is_odd(y) ? -size : size;
  }
  if (x > 0.0) return power_of_positive(a, y);
  if (!is_whole(y)) return std::numeric_limits<double>::quiet_NaN();
  return is_odd(y) ? -power_of_positive(a, y) : power_of_positive(a, y);
}

}  // namespace faultline::elementary
