// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "lib/log/column_families.hpp"

namespace faultline {
namespace {

/// A column whose name contains a quantity, and the words that may be its joint's name.
struct NamedColumn {
  int column = -1;
  ParsedName reading;
};

std::vector<NamedColumn> read_columns(const std::vector<std::string>& names,
                                      const std::function<bool(int)>& is_free) {
  std::vector<NamedColumn> columns;
  for (int i = 0; i < std::ssize(names); ++i)
    if (is_free(i))
      if (const ParsedName reading = parse_name(names[i]); reading.quantity) columns.push_back({i, reading});
  return columns;
}

/// Returns the positions with the most columns of one fitness; those of another fitness are the same joints.
std::vector<NamedColumn> positions_of(const std::vector<NamedColumn>& columns) {
  std::map<int, std::vector<NamedColumn>> by_kind;
  for (const NamedColumn& column : columns)
    if (column.reading.quantity == Quantity::q) by_kind[column.reading.fitness].push_back(column);
  std::vector<NamedColumn> most;
  for (auto& [fitness, kind] : by_kind)
    if (kind.size() >= most.size()) most = kind;
  return most;
}

bool are_joints(const std::vector<NamedColumn>& positions) {
  std::set<std::string> words;
  int without_number = 0;
  for (const NamedColumn& position : positions) {
    if (position.reading.joint.empty() || !words.insert(position.reading.joint).second) return false;
    without_number += !position.reading.number;
  }
  constexpr int kLeast = 2;
  return without_number >= kLeast;
}

/// Returns the column of a quantity that fits a joint best; -1 for none.
int best_column(const std::vector<NamedColumn>& columns, Quantity quantity, const std::string& joint) {
  const NamedColumn* best = nullptr;
  for (const NamedColumn& column : columns)
    if (column.reading.quantity == quantity && column.reading.joint == joint &&
        (!best || column.reading.fitness > best->reading.fitness))
      best = &column;
  return best ? best->column : -1;
}

}  // namespace

std::vector<std::pair<Channel, int>> named_joints(const std::vector<std::string>& names,
                                                  const std::function<bool(int)>& is_free) {
  const std::vector<NamedColumn> columns = read_columns(names, is_free);
  const std::vector<NamedColumn> positions = positions_of(columns);
  std::vector<std::pair<Channel, int>> found;
  if (!are_joints(positions)) return found;
  for (int j = 0; j < std::ssize(positions); ++j) {
    found.emplace_back(Channel{Quantity::q, j + 1}, positions[j].column);
    for (const Quantity quantity : kJointQuantities)
      if (const int column = best_column(columns, quantity, positions[j].reading.joint);
          quantity != Quantity::q && column >= 0)
        found.emplace_back(Channel{quantity, j + 1}, column);
  }
  return found;
}

}  // namespace faultline
