// SPDX-License-Identifier: MIT
#include "lib/core/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/elementary/elementary.hpp"

namespace faultline {

std::string digits_text(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

std::string value_text(double value) {
  if (std::isnan(value)) return "-";
  return std::abs(value) >= 1000.0 && std::abs(value) < 1e7 ? fmt::format("{:.0f}", value)
                                                            : digits_text(value, 3);
}

std::string percent_text(double share) { return fmt::format("{:.0f} %", 100.0 * share); }

std::string seconds_text(double time_s) { return fmt::format("{:.3f} s", time_s); }

std::string time_text(double time_s, double sample_period_s) {
  if (!std::isfinite(time_s)) return "unknown";
  const bool known = std::isfinite(sample_period_s) && sample_period_s > 0.0;
  const int decimals =
      known ? std::clamp(static_cast<int>(std::ceil(-elementary::log10(sample_period_s))), 1, 6) : 3;
  return fmt::format("{:.{}f} s", time_s, std::max(decimals, 3));
}

double time_zero(double start_s) { return std::abs(start_s) >= 1e5 ? std::floor(start_s) : 0.0; }

}  // namespace faultline
