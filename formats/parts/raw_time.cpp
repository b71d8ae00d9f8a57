// SPDX-License-Identifier: MIT
#include "formats/parts/raw_time.hpp"

#include <string>

#include "lib/log/column_families.hpp"
#include "lib/log/units.hpp"

namespace faultline {

double RawTime::at(const RawBlock& block, int row) const {
  const double seconds = factor * block.columns[column][row];
  return nanoseconds < 0 ? seconds : seconds + 1e-9 * block.columns[nanoseconds][row];
}

std::optional<RawTime> find_raw_time(const std::vector<RawColumn>& columns) {
  std::vector<std::string> names;
  for (int i = 0; i < std::ssize(columns); ++i) {
    if (columns[i].meaning == Channel{}) return RawTime{i, -1, 1.0};
    names.push_back(columns[i].name);
  }
  if (const int column = find_time_column(names); column >= 0)
    return RawTime{column, -1, si_factor(columns[column].unit).value_or(1.0)};
  if (const auto pair = find_time_pair(names)) return RawTime{pair->seconds, pair->nanoseconds, 1.0};
  return std::nullopt;
}

}  // namespace faultline
