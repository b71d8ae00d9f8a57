// SPDX-License-Identifier: MIT
#include "lib/log/column_families.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace faultline {
namespace {

/// Returns the first family with the highest rank among those that `is_meant` accepts; null for none.
template <typename IsMeant, typename Rank>
const ColumnFamily* best_of(const std::vector<ColumnFamily>& families, IsMeant is_meant, Rank rank) {
  const ColumnFamily* best = nullptr;
  for (const ColumnFamily& family : families)
    if (is_meant(family) && (!best || rank(family) > rank(*best))) best = &family;
  return best;
}

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

std::vector<ColumnFamily> column_families(const std::vector<std::string>& names,
                                          const std::function<bool(int)>& is_free) {
  std::vector<ColumnFamily> families;
  std::map<std::string, std::size_t> index;
  for (const auto& [column, reading] : read_columns(names, is_free)) {
    const auto [at, fresh] = index.emplace(reading.stem, families.size());
    if (fresh)
      families.push_back(
          {*reading.quantity, reading.fitness, reading.as_torque, {}, reading.number.has_value()});
    ColumnFamily& family = families[at->second];
    family.fitness = std::max(family.fitness, reading.fitness);
    family.column_of.emplace(reading.number.value_or(1), column);
  }
  return families;
}

const ColumnFamily* best_family(const std::vector<ColumnFamily>& families, Quantity quantity,
                                const IsUsable& usable) {
  return best_of(
      families, [&](const ColumnFamily& family) { return family.quantity == quantity && usable(family); },
      [](const ColumnFamily& family) {
        return std::tuple(family.fitness >= 100, family.numbered, family.fitness, family.columns());
      });
}

const ColumnFamily* best_torque(const std::vector<ColumnFamily>& families, const IsUsable& usable) {
  return best_of(
      families, [&](const ColumnFamily& family) { return is_torque(family.quantity) && usable(family); },
      [](const ColumnFamily& family) {
        const bool canonical = family.quantity == Quantity::tau && family.fitness >= 100;
        return std::tuple(canonical, family.numbered, family.as_torque, family.columns());
      });
}

std::optional<TimePair> find_time_pair(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (const auto& [whole, part] : {std::pair{"sec", "nanosec"}, {"secs", "nsecs"}}) {
      const std::string& name = names[i];
      const std::string prefix =
          name.substr(0, name.size() - std::min(name.size(), std::string(whole).size()));
      if (prefix + whole != name) continue;
      const auto nanoseconds = std::find(names.begin(), names.end(), prefix + part);
      if (nanoseconds == names.end()) continue;
      if (prefix.find("time_from_start") != std::string::npos) continue;
      return TimePair{static_cast<int>(i), static_cast<int>(nanoseconds - names.begin())};
    }
  }
  return std::nullopt;
}

std::vector<std::pair<Channel, int>> named_joints(const std::vector<std::string>& names,
                                                  const std::function<bool(int)>& is_free) {
  const std::vector<NamedColumn> columns = read_columns(names, is_free);
  const std::vector<NamedColumn> positions = positions_of(columns);
  std::vector<std::pair<Channel, int>> found;
  if (!are_joints(positions)) return found;
  for (int j = 0; j < std::ssize(positions); ++j) {
    found.emplace_back(Channel{Quantity::q, Joint::at(j)}, positions[j].column);
    for (const Quantity quantity : kJointQuantities)
      if (const int column = best_column(columns, quantity, positions[j].reading.joint);
          quantity != Quantity::q && column >= 0)
        found.emplace_back(Channel{quantity, Joint::at(j)}, column);
  }
  return found;
}

}  // namespace faultline
