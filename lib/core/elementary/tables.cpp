// SPDX-License-Identifier: MIT
#include "lib/core/elementary/scaled_exp.hpp"
#include "lib/core/elementary/scaled_log.hpp"

namespace faultline::elementary {
namespace {

using Fixed = __int128;  ///< a number times 2^kPlaces, below 2 in size
constexpr int kPlaces = 124;
constexpr Fixed kOnePoint = Fixed{1} << kPlaces;

constexpr double power_of_two(int exponent) {
  double power = 1.0;
  for (int i = 0; i < exponent; ++i) power *= 2.0;
  for (int i = 0; i > exponent; --i) power *= 0.5;
  return power;
}

/// Returns a b, neither negative.
constexpr Fixed product_of_fixed(Fixed a, Fixed b) {
  constexpr Fixed kHalf = (Fixed{1} << 62) - 1;
  const Fixed a1 = a >> 62, a0 = a & kHalf, b1 = b >> 62, b0 = b & kHalf;
  return a1 * b1 + ((a1 * b0 + a0 * b1 + (a0 * b0 >> 62)) >> 62);
}

/// Returns the number as a multiple of 2^-places, and the rest.
constexpr DoubleDouble in_two(Fixed x, int places) {
  const Fixed unit = Fixed{1} << (kPlaces - places), steps = (x + unit / 2) >> (kPlaces - places);
  return {static_cast<double>(steps) * power_of_two(-places),
          static_cast<double>(x - steps * unit) * power_of_two(-kPlaces)};
}

constexpr Fixed square_root_of(Fixed x) {
  Fixed root = 0;
  for (Fixed bit = kOnePoint; bit > 0; bit >>= 1)
    if (product_of_fixed(root + bit, root + bit) <= x) root += bit;
  return root;
}

/// 2^(k / 128) as the product of the roots 2^(1/2), 2^(1/4), .. for the bits of k.
constexpr std::array<DoubleDouble, 128> roots_of_two() {
  std::array<Fixed, 128> roots{};
  roots.fill(kOnePoint);
  Fixed root = 2 * kOnePoint;
  for (unsigned bit = 64; bit > 0; bit /= 2) {
    root = square_root_of(root);
    for (unsigned k = 0; k < roots.size(); ++k)
      if (k & bit) roots[k] = product_of_fixed(roots[k], root);
  }
  std::array<DoubleDouble, 128> out;
  for (unsigned k = 0; k < roots.size(); ++k) out[k] = in_two(roots[k], 52);
  return out;
}

/// Returns log(a / b), a >= b, by the series of 2 artanh((a - b) / (a + b)).
constexpr Fixed log_of_ratio(int a, int b) {
  Fixed power = kOnePoint / (a + b) * (a - b), sum = 0;
  const Fixed square = product_of_fixed(power, power);
  for (int n = 1; power > 0; n += 2, power = product_of_fixed(power, square)) sum += 2 * (power / n);
  return sum;
}

constexpr std::array<LogEntry, 128> log_entries() {
  std::array<LogEntry, 128> out;
  for (int k = 0; k < 128; ++k) {
    // 512 / m for the middle of the interval of m, or 1024 / m; around m = 1 it is 512.
    const int doubled = k < kFirstHalved ? 1 : 2, below = 2 * (128 + k) + 1;
    int inverse = (512 * 256 * doubled + below / 2) / below;
    if (k == 0 || k == 127) inverse = 512;
    const bool above = inverse > 512;
    DoubleDouble log = in_two(above ? log_of_ratio(inverse, 512) : log_of_ratio(512, inverse), 42);
    if (above) log = {-log.high, -log.low};
    out[k] = {inverse / 512.0, log.high, log.low};
  }
  return out;
}

}  // namespace

constexpr std::array<DoubleDouble, 128> kRootsOfTwo = roots_of_two();
constexpr std::array<LogEntry, 128> kLogEntries = log_entries();

}  // namespace faultline::elementary
