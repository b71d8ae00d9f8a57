// SPDX-License-Identifier: MIT
#include "formats/csv/csv_sparse.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "formats/csv/csv_fields.hpp"

namespace faultline {
namespace {

using Presence = std::vector<bool>;  ///< by field

constexpr int kLeastRows = 10;
/// Columns that all rows of such a table have: the time.
constexpr int kCommonColumns = 1;
/// Share of the rows that a way of being filled must have to count.
constexpr double kLeastShare = 0.1;

bool share_nothing(const Presence& a, const Presence& b, const Presence& always) {
  bool some_a = false, some_b = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (always[i]) continue;
    if (a[i] && b[i]) return false;
    some_a = some_a || a[i];
    some_b = some_b || b[i];
  }
  return some_a && some_b;
}

}  // namespace

bool is_sparse_table(std::span<const CsvLine> lines, int fields, char decimal) {
  std::map<Presence, int> rows_of;
  Presence always(static_cast<std::size_t>(fields), true);
  int rows = 0;
  for (const CsvLine& line : lines) {
    if (!is_data(line, fields)) continue;
    Presence present;
    for (const std::string_view field : line.fields)
      present.push_back(read_cell(field, decimal).kind != CellKind::missing);
    for (std::size_t i = 0; i < always.size(); ++i) always[i] = always[i] && present[i];
    ++rows_of[present];
    ++rows;
  }
  if (rows < kLeastRows || std::count(always.begin(), always.end(), true) > kCommonColumns) return false;
  for (const auto& [a, times_a] : rows_of)
    for (const auto& [b, times_b] : rows_of)
      if (times_a >= kLeastShare * rows && times_b >= kLeastShare * rows && share_nothing(a, b, always))
        return true;
  return false;
}

}  // namespace faultline
