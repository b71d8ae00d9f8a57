// SPDX-License-Identifier: MIT
#include "lib/report/fact_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/core/number_text.hpp"

namespace faultline {

std::string fact_text(double value, const std::string& unit) {
  return std::isfinite(value) ? digits_text(value, 5) + (unit.empty() ? "" : " ") + unit : "-";
}

std::string text_table(const FactTable& table) {
  if (table.rows.empty()) return "";
  std::vector<std::vector<std::string>> lines = table.rows;
  if (!table.head.empty()) lines.insert(lines.begin(), table.head);
  std::vector<std::size_t> width;
  for (const auto& line : lines)
    for (std::size_t c = 0; c < line.size(); ++c) {
      if (c == width.size()) width.push_back(0);
      width[c] = std::max(width[c], line[c].size());
    }
  std::string text = table.title + "\n";
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t c = 0; c < line.size(); ++c) row += fmt::format("  {:<{}}", line[c], width[c]);
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text;
}

}  // namespace faultline
