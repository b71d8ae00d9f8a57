// SPDX-License-Identifier: MIT
#pragma once

namespace faultline {

/// Returns the place between `low` and `high` at which `f` is least, if it falls and then rises there; each
/// round calls it once and keeps .62 of the interval (Kiefer, 1953).
template <typename F>
double golden_section(double low, double high, int rounds, const F& f) {
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = f(a), at_b = f(b);
  for (int i = 0; i < rounds; ++i) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low);
      if (i + 1 < rounds) at_a = f(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low);
      if (i + 1 < rounds) at_b = f(b);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace faultline
