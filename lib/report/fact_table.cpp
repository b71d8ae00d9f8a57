// SPDX-License-Identifier: MIT
#include "lib/report/fact_table.hpp"

#include <cmath>

#include "lib/core/number_text.hpp"

namespace faultline {

std::string fact_text(double value, const std::string& unit) {
  return std::isfinite(value) ? digits_text(value, 5) + (unit.empty() ? "" : " ") + unit : "-";
}

}  // namespace faultline
