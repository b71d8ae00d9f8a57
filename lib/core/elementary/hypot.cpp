// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"

namespace faultline::elementary {
namespace {

constexpr double kHypotFar = 0x1p60;  // ratio above which the shorter side has no effect
constexpr double kLargest = 0x1p500,
                 kSmallest = 0x1p-400;  // between them squares neither over- nor underflow

/// Returns the root h of the rounded sum of squares, a >= b > 0, both between kSmallest and kLargest, minus
/// (h^2 - a^2 - b^2) / (2 h), in differences that cancel little (Borges 2021).
double root_of_squares(double a, double b) {
  const double root = std::sqrt(a * a + b * b);
  double excess = 0.0;
  if (root <= 2.0 * b) {
    const double over = root - b;
    excess = a * (2.0 * over - a) + over * (over - 2.0 * (a - b));
  } else {
    const double over = root - a;
    excess = 2.0 * over * (a - 2.0 * b) + ((4.0 * over - b) * b + over * over);
  }
  return root - excess / (2.0 * root);
}

}  // namespace

double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return std::numeric_limits<double>::infinity();
  if (x != x || y != y) return x + y;
  const double a = std::fmax(std::abs(x), std::abs(y)), b = std::fmin(std::abs(x), std::abs(y));
  if (b <= a / kHypotFar) return a + b;
  if (a > kLargest) return root_of_squares(a * 0x1p-600, b * 0x1p-600) * 0x1p600;
  if (b < kSmallest) return root_of_squares(a * 0x1p600, b * 0x1p600) * 0x1p-600;
  return root_of_squares(a, b);
}

}  // namespace faultline::elementary
