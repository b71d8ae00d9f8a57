// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "lib/core/elementary/double_double.hpp"

namespace faultline::elementary {

/// 2^(k / 128).
extern const std::array<DoubleDouble, 128> kRootsOfTwo;

/// (high + low) 2^power, high from 1 to below 2, low below 2^-7.
struct ScaledExp {
  double high, low;
  int power;

  double value() const {
    return power < -1021 || power > 1022 ? std::ldexp(high + low, power) : value_of_normal();
  }
  /// Returns the value, if neither it nor twice it is subnormal or infinite.
  double value_of_normal() const {
    return std::bit_cast<double>(std::bit_cast<std::int64_t>(high + low) +
                                 (static_cast<std::int64_t>(power) << 52));
  }
};

/// Returns e^(x + more), |x| below 2^11 and `more` below an ulp of it; relative error about 2^-61.
/// x = (128 power + index) ln 2 / 128 + r with |r| <= ln 2 / 256.
inline ScaledExp scaled_exp(double x, double more = 0.0) {
  constexpr double kRounder = 0x1.8p52;  // added and subtracted: rounds to the nearest whole number
  constexpr double kPerStep = 0x1.71547652b82fep+7;
  constexpr double kStepHigh = 0x1.62e42fefcp-8, kStepLow = -0x1.c610ca86c3899p-44;
  const double shifted = x * kPerStep + kRounder, steps = shifted - kRounder;
  const double r = ((x - steps * kStepHigh) - steps * kStepLow) + more;
  const double r2 = r * r;
  const double grown = r + r2 * ((0x1.fffffffffff57p-2 + r * 0x1.5555555555525p-3) +
                                 r2 * (0x1.55555acf8df82p-5 + r * 0x1.1111143255ff1p-7));  // e^r - 1
  const auto whole = static_cast<std::int32_t>(std::bit_cast<std::int64_t>(shifted));
  const DoubleDouble& root = kRootsOfTwo[whole & 127];
  return {root.high, root.low + root.high * grown, whole >> 7};
}

}  // namespace faultline::elementary
