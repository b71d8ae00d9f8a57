// SPDX-License-Identifier: MIT
#include <cmath>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/elementary/scaled_exp.hpp"

namespace faultline::elementary {
namespace {

constexpr double kTanhTiny = 0x1p-28;  // tanh rounds to x below it
constexpr double kSmall = 0.55;        // tanh is half of its limit there
constexpr double kOne = 20.0;          // beyond it tanh rounds to 1

/// Returns (tanh(x) - x) / x^3 for z = x^2, |x| up to kSmall.
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

double tanh(double x) {
  const double a = std::abs(x);
  if (a < kSmall) {
    if (a < kTanhTiny) return x;
    const double z = x * x;
    return x + x * z * odd_tail(z);
  }
  if (!(a < kOne)) return x == x ? std::copysign(1.0, x) : x;
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
