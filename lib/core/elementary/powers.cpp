// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/elementary/scaled_exp.hpp"
#include "lib/core/elementary/scaled_log.hpp"

namespace faultline::elementary {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPlain = 707.0;           // up to there e^x and e^-x are normal numbers
constexpr double kMostExponent = 710.0;    // of e, above it the power is infinite
constexpr double kLeastExponent = -746.0;  // below it the power is zero

bool is_ordinary(double x) { return x > 0.0 && x < kInfinity; }

/// Returns the logarithm of any other argument than a positive finite number.
double log_of_other(double x) {
  if (x == 0.0) return -kInfinity;
  return x < 0.0 ? kNaN : x;
}

bool is_whole(double y) { return std::trunc(y) == y; }
bool is_odd(double y) { return is_whole(y) && !is_whole(0.5 * y); }

/// Returns x^y for x above zero and finite, y finite.
double power_of_positive(double x, double y) {
  const DoubleDouble log = precise_log(x);
  const double about = y * log.high;
  if (about > kMostExponent) return kInfinity;
  if (about < kLeastExponent) return 0.0;
  const DoubleDouble product = product_of(y, log.high);
  const DoubleDouble exponent = sum_of_ordered(product.high, product.low + y * log.low);
  return scaled_exp(exponent.high, exponent.low).value();
}

/// Returns x^y if x or y is infinite or x is zero; x is not negative.
double power_at_limits(double x, double y) {
  if (std::isinf(y)) {
    if (x == 1.0) return 1.0;
    return (x > 1.0) == (y > 0.0) ? kInfinity : 0.0;
  }
  return (x == 0.0) == (y > 0.0) ? 0.0 : kInfinity;
}

constexpr double kTanhTiny = 0x1p-28;  // tanh rounds to x below it
constexpr double kTanhSmall = 0.55;    // tanh is half of its limit there
constexpr double kTanhOne = 20.0;      // beyond it tanh rounds to 1

/// Returns (tanh(x) - x) / x^3 for z = x^2, |x| up to kTanhSmall.
double odd_tail(double z) {
  const double z2 = z * z, z4 = z2 * z2;
  const double low = (-0x1.5555555555555p-2 + z * 0x1.1111111111109p-3) +
                     z2 * (-0x1.ba1ba1ba1a723p-5 + z * 0x1.664f48822e32fp-6);
  const double middle = (-0x1.226e3539a2567p-7 + z * 0x1.d6d3c5fa306d8p-9) +
                        z2 * (-0x1.7da25d2dc94ddp-10 + z * 0x1.3547b99663ef6p-11);
  const double high = (-0x1.f41cac23a5451p-13 + z * 0x1.8c91aa027e00fp-14) +
                      z2 * (-0x1.1ad8e00df097cp-15 + z * 0x1.08286da59d447p-17);
  return low + z4 * (middle + z4 * high);
}

}  // namespace

double exp(double x) {
  if (std::abs(x) < kPlain) return scaled_exp(x).value_of_normal();
  if (x > kMostExponent) return kInfinity;
  if (x < kLeastExponent) return 0.0;
  return x == x ? scaled_exp(x).value() : x;
}

double log(double x) {
  if (std::bit_cast<std::uint64_t>(x) - kLeastNormal >= kInfinite - kLeastNormal)
    return is_ordinary(x) ? precise_log(x).high : log_of_other(x);
  const LogParts p = log_parts(x);
  const double steps = p.power * kLn2High + p.entry.log_high;  // exact, and zero or above 1 / 256
  const DoubleDouble r = sum_of_ordered(p.coarse, p.fine);     // exact if steps is zero
  const DoubleDouble sum = sum_of_ordered(steps, r.high);
  const double small = r.low + (p.entry.log_low + p.power * kLn2Low);
  return sum.high + (sum.low + (small + r.high * r.high * (r.high * log_tail(r.high) - 0.5)));
}

double log10(double x) {
  constexpr DoubleDouble kPerLog{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};
  if (!is_ordinary(x)) return log_of_other(x);
  return (precise_log(x) * kPerLog).high;
}

double log1p(double x) {
  if (std::abs(x) < 0x1p-54) return x;
  if (!(x > -1.0 && x < kInfinity)) return x == x ? log_of_other(1.0 + x) : x;
  const DoubleDouble sum = sum_of(1.0, x);
  return precise_log(sum.high, sum.low).high;
}

double asinh(double x) {
  constexpr double kSmall = 0x1p-28, kLarge = 0x1p28;
  constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
  const double a = std::abs(x);
  if (a < kSmall || !(a < kInfinity)) return x;
  if (a > kLarge) return std::copysign((precise_log(a) + kLn2).high, x);
  const DoubleDouble sum = square_root(product_of(a, a) + DoubleDouble{1.0}) + DoubleDouble{a};
  return std::copysign(precise_log(sum.high, sum.low).high, x);
}

double pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (x != x || y != y) return x + y;
  const double a = std::abs(x);
  if (a == 0.0 || std::isinf(a) || std::isinf(y)) {
    const double size = power_at_limits(a, y);
    return std::signbit(x) && is_odd(y) ? -size : size;
  }
  if (x > 0.0) return power_of_positive(a, y);
  if (!is_whole(y)) return kNaN;
  return is_odd(y) ? -power_of_positive(a, y) : power_of_positive(a, y);
}

double tanh(double x) {
  const double a = std::abs(x);
  if (a < kTanhSmall) {
    if (a < kTanhTiny) return x;
    const double z = x * x;
    return x + x * z * odd_tail(z);
  }
  if (!(a < kTanhOne)) return x == x ? std::copysign(1.0, x) : x;
  // 1 - 2 / (e^2a + 1)
  const ScaledExp e = scaled_exp(2.0 * a);
  const double scale = std::bit_cast<double>(static_cast<std::int64_t>(1023 + e.power) << 52);
  const DoubleDouble power = sum_of_ordered(e.high * scale, e.low * scale);
  const DoubleDouble sum = sum_of_ordered(power.high, 1.0);
  const double below = 2.0 / sum.high;
  const double missing = 0.5 * below * below * (sum.low + power.low);
  const DoubleDouble rest = sum_of_ordered(1.0, -below);
  return std::copysign(rest.high + (rest.low + missing), x);
}

}  // namespace faultline::elementary
