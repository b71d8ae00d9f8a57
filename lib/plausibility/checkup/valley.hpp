// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace faultline {

/// Returns the index of the least value, interpolated by a parabola through it and the values up to three
/// places to both sides. NaN if the least one is the first or the last, or there is no distinct minimum.
inline double valley_of(std::span<const double> values) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] < values[least]) least = i;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (least == 0 || least + 1 >= values.size()) return nan;
  const std::size_t reach = std::min({least, values.size() - 1 - least, std::size_t{3}});
  const double left = values[least - reach], middle = values[least], right = values[least + reach];
  const double bend = left - 2.0 * middle + right;
  if (!(bend > 0.0)) return nan;
  return static_cast<double>(least) + 0.5 * static_cast<double>(reach) * (left - right) / bend;
}

}  // namespace faultline
