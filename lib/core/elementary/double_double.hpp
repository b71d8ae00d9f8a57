// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

/// Numbers of about 106 bits as unevaluated sums of two doubles, for intermediate values that need more bits
/// than the result (Dekker 1971). Exact only if nothing overflows and the compiler fuses or reorders nothing.
namespace faultline::elementary {

struct DoubleDouble {
  double high = 0.0, low = 0.0;
};

/// Returns a + b exactly, |a| >= |b| or a = 0.
inline DoubleDouble sum_of_ordered(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Returns a + b exactly.
inline DoubleDouble sum_of(double a, double b) {
  const double sum = a + b, b_in_sum = sum - a;
  return {sum, (a - (sum - b_in_sum)) + (b - b_in_sum)};
}

/// Returns the upper 26 bits of a, and the rest.
inline DoubleDouble halves_of(double a) {
  constexpr double kSplit = 0x1p27 + 1.0;
  const double scaled = kSplit * a, high = scaled - (scaled - a);
  return {high, a - high};
}

/// Returns a b exactly, |a| and |b| below 2^996 and their product not near the smallest numbers.
inline DoubleDouble product_of(double a, double b) {
  const double product = a * b;
  const DoubleDouble x = halves_of(a), y = halves_of(b);
  return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

inline DoubleDouble operator-(DoubleDouble a) { return {-a.high, -a.low}; }

inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble sum = sum_of(a.high, b.high);
  return sum_of_ordered(sum.high, sum.low + (a.low + b.low));
}

inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble product = product_of(a.high, b.high);
  return sum_of_ordered(product.high, product.low + (a.high * b.low + a.low * b.high));
}

inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double quotient = a.high / b.high;
  const DoubleDouble back = product_of(quotient, b.high);
  const double left = (((a.high - back.high) - back.low) + a.low) - quotient * b.low;
  return sum_of_ordered(quotient, left / b.high);
}

/// Returns the square root of a > 0.
inline DoubleDouble square_root(DoubleDouble a) {
  const double root = std::sqrt(a.high);
  const DoubleDouble back = product_of(root, root);
  return sum_of_ordered(root, (((a.high - back.high) - back.low) + a.low) / (2.0 * root));
}

}  // namespace faultline::elementary
