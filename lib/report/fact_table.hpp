// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// Facts for a person to read, a row each.
struct FactTable {
  std::string title;
  std::vector<std::string> head;  ///< empty for name and value
  std::vector<std::vector<std::string>> rows;
};

/// A value in a table: five significant digits, and the unit if there is one; "-" when not finite.
std::string fact_text(double value, const std::string& unit = "");

}  // namespace faultline
