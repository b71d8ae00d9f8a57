// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/elementary/scaled_exp.hpp"

namespace faultline::elementary {
namespace {

constexpr double kPlain = 707.0;        // up to there e^x and e^-x are normal numbers
constexpr double kExpAllAbove = 710.0;  // above it e^x is infinite
constexpr double kAllBelow = -746.0;    // below it e^x is zero

}  // namespace

double exp(double x) {
  if (std::abs(x) < kPlain) return scaled_exp(x).value_of_normal();
  if (x > kExpAllAbove) return std::numeric_limits<double>::infinity();
  if (x < kAllBelow) return 0.0;
  return x == x ? scaled_exp(x).value() : x;
}

}  // namespace faultline::elementary
