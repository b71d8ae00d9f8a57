// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "lib/core/elementary/double_double.hpp"
#include "lib/core/elementary/elementary.hpp"
#include "lib/core/elementary/right_angles.hpp"

namespace faultline::elementary {
namespace {

constexpr double kHalfRightAngle = 0x1.921fb54442d18p-1;
constexpr double kCosLargest = std::numeric_limits<double>::max();
constexpr double kMedium = 1e6;    // up to there the parts of a right angle times the quadrant are exact
constexpr double kTiny = 0x1p-27;  // the sine rounds to x below it
constexpr double kClose =
    0x1p-13;  // nearer to a whole right angle those parts do not suffice or are out of order

/// Returns the right angles of |x| below kMedium (Cody and Waite 1980).
[[gnu::always_inline]] inline RightAngles right_angles(double x) {
  constexpr double kRounder = 0x1.8p52;
  constexpr double kPerRightAngle = 0x1.45f306dc9c883p-1;
  constexpr double kFirst = 0x1.921fb544p+0, kSecond = 0x1.0b4611a6p-34, kThird = 0x1.3198a2e037073p-69;
  const double shifted = x * kPerRightAngle + kRounder, count = shifted - kRounder;
  const double most = x - count * kFirst;
  if (std::abs(most) < kClose) return right_angles_of_any(x);
  const DoubleDouble rest = sum_of_ordered(most, -count * kSecond);
  const DoubleDouble angle = sum_of_ordered(rest.high, rest.low - count * kThird);
  return {static_cast<int>(count) & 3, angle.high, angle.low};
}

/// Returns the right angles of a finite x beyond half a right angle.
[[gnu::always_inline]] inline RightAngles reduced(double x) {
  return std::abs(x) < kMedium ? right_angles(x) : right_angles_of_any(x);
}

[[gnu::always_inline]] inline double sine_of(double x, double more) {
  const double z = x * x, z2 = z * z;
  const double tail =
      (-0x1.5555555555555p-3 + z * 0x1.1111111111110p-7) +
      z2 * ((-0x1.a01a01a019933p-13 + z * 0x1.71de3a54600cap-19) +
            z2 * ((-0x1.ae645411d76a9p-26 + z * 0x1.61217e4ef55f8p-33) - z2 * 0x1.ab1764e7b2047p-41));
  return x + (x * z * tail + more * (1.0 - 0.5 * z));
}

[[gnu::always_inline]] inline double cosine_of(double x, double more) {
  const double z = x * x, z2 = z * z, half = 0.5 * z, most = 1.0 - half;
  const double tail =
      (0x1.5555555555555p-5 - z * 0x1.6c16c16c16c16p-10) +
      z2 * ((0x1.a01a01a019d08p-16 - z * 0x1.27e4fb7712996p-22) +
            z2 * ((0x1.1eed8deb2dd23p-29 - z * 0x1.9394b9651e761p-37) + z2 * 0x1.ab77f828b3725p-45));
  return most + (((1.0 - most) - half) + (z2 * tail - x * more));
}

/// Returns NaN for infinities and NaN.
double of_other(double x) { return x - x; }

}  // namespace

double sin(double x) {
  const double size = std::abs(x);
  if (size <= kHalfRightAngle) return size < kTiny ? x : sine_of(x, 0.0);
  if (!(size <= kCosLargest)) return of_other(x);
  const RightAngles a = reduced(x);
  const double value = a.quadrant & 1 ? cosine_of(a.high, a.low) : sine_of(a.high, a.low);
  return a.quadrant & 2 ? -value : value;
}

double cos(double x) {
  const double size = std::abs(x);
  if (size <= kHalfRightAngle) return cosine_of(x, 0.0);
  if (!(size <= kCosLargest)) return of_other(x);
  const RightAngles a = reduced(x);
  const double value = a.quadrant & 1 ? sine_of(a.high, a.low) : cosine_of(a.high, a.low);
  return (a.quadrant + 1) & 2 ? -value : value;
}

SinCos sin_cos(double x) {
  const double size = std::abs(x);
  if (size <= kHalfRightAngle) return {size < kTiny ? x : sine_of(x, 0.0), cosine_of(x, 0.0)};
  if (!(size <= kCosLargest)) return {of_other(x), of_other(x)};
  const RightAngles a = reduced(x);
  const double s = sine_of(a.high, a.low), c = cosine_of(a.high, a.low);
  const double sine = a.quadrant & 1 ? c : s, cosine = a.quadrant & 1 ? s : c;
  return {a.quadrant & 2 ? -sine : sine, (a.quadrant + 1) & 2 ? -cosine : cosine};
}

}  // namespace faultline::elementary
