// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "lib/core/elementary/double_double.hpp"
#include "lib/core/elementary/elementary.hpp"

namespace faultline::elementary {
namespace {

/// atan(k / 16).
constexpr std::array<DoubleDouble, 17> kAngles{{
    {0x0.0p+0, 0x0.0p+0},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
}};
constexpr DoubleDouble kRightAngle{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr DoubleDouble kHalfTurn{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr double kFar = 0x1p60;  // of a larger ratio the angle is a right one, of its inverse the inverse

/// Returns atan of a ratio from 0 to 1: that of the nearest k / 16, plus that of the rest.
DoubleDouble angle_of(DoubleDouble ratio) {
  const double step = std::floor(ratio.high * 16.0 + 0.5), near = step / 16.0;
  DoubleDouble rest = ratio;
  if (step > 0.0) rest = (ratio + DoubleDouble{-near}) / (DoubleDouble{1.0} + ratio * DoubleDouble{near});
  const double t = rest.high, z = t * t;
  const double tail = (-0x1.5555555555555p-2 + z * 0x1.999999999999ap-3) +
                      z * z *
                          ((-0x1.24924924920f0p-3 + z * 0x1.c71c71bf6fca8p-4) +
                           z * z * (-0x1.745cdca4449efp-4 + z * 0x1.3a452e6fa743dp-4));
  return kAngles[static_cast<int>(step)] + sum_of_ordered(t, rest.low + t * z * tail);
}

/// Returns the angle of (x, y), both above zero and finite, neither kFar times the other.
DoubleDouble direction(double y, double x) {
  if (y <= x) return angle_of(DoubleDouble{y} / DoubleDouble{x});
  return kRightAngle + -angle_of(DoubleDouble{x} / DoubleDouble{y});
}

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

double atan(double x) {
  const double a = std::abs(x);
  if (!(a < kFar)) return x == x ? std::copysign(kRightAngle.high, x) : x;
  if (a < 1.0 / kFar) return x;
  return std::copysign(direction(a, 1.0).high, x);
}

double atan2(double y, double x) {
  if (x != x || y != y) return x + y;
  const double right = std::abs(x), up = std::abs(y);
  const bool back = std::signbit(x);
  double angle = 0.0;
  if (std::isinf(x) && std::isinf(y)) {
    angle = back ? 3.0 * (kHalfTurn.high / 4.0) : kHalfTurn.high / 4.0;
  } else if (up == 0.0 || std::isinf(x)) {
    angle = back ? kHalfTurn.high : 0.0;
  } else if (right == 0.0 || std::isinf(y) || up / right >= kFar) {
    angle = kRightAngle.high;
  } else if (up / right <= 1.0 / kFar) {
    angle = back ? kHalfTurn.high : up / right;
  } else {
    int exponent = 0;  // removed from both, so that products neither over- nor underflow
    std::frexp(std::fmax(right, up), &exponent);
    const DoubleDouble sharp = direction(std::ldexp(up, -exponent), std::ldexp(right, -exponent));
    angle = back ? (kHalfTurn + -sharp).high : sharp.high;
  }
  return std::copysign(angle, y);
}

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
