// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace faultline {

/// Multiples of a period. For periods of whole microseconds, returns the doubles nearest to the decimal
/// times, so that a log has 3.953 and not 3.9530000000000003.
class Clock {
 public:
  explicit Clock(double period_s) : period_s_(period_s) {
    const double micro = period_s * 1e6;
    if (std::round(micro) >= 1.0 && std::abs(micro - std::round(micro)) < 1e-6) micro_ = std::round(micro);
  }
  double at(std::int64_t tick) const {
    const auto k = static_cast<double>(tick);
    return micro_ > 0.0 ? k * micro_ / 1e6 : k * period_s_;
  }

 private:
  double period_s_;
  double micro_ = 0.0;
};

}  // namespace faultline
