// SPDX-License-Identifier: MIT
#include "lib/core/csv_cell.hpp"

#include <fmt/format.h>

#include <cmath>

namespace faultline {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string csv_joint(int joint) { return joint > 0 ? std::to_string(joint) : ""; }

}  // namespace faultline
