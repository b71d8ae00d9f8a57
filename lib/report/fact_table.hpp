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

/// The table on a terminal: its title, then its rows in columns, two blanks before each.
std::string text_table(const FactTable& table);

/// A value in a table: five significant digits, and the unit if there is one; "-" when not finite.
std::string fact_text(double value, const std::string& unit = "");

}  // namespace faultline
