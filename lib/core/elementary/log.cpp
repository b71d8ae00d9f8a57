// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "lib/core/elementary/elementary.hpp"
#include "lib/core/elementary/scaled_log.hpp"

namespace faultline::elementary {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool is_ordinary(double x) { return x > 0.0 && x < kInfinity; }

/// Returns the logarithm of any other argument than a positive finite number.
double log_of_other(double x) {
  if (x == 0.0) return -kInfinity;
  return x < 0.0 ? kNaN : x;
}

}  // namespace

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

}  // namespace faultline::elementary
