// SPDX-License-Identifier: MIT
#include "lib/log/column_families.hpp"

#include <algorithm>
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

}  // namespace

std::vector<ColumnFamily> column_families(const std::vector<std::string>& names,
                                          const std::function<bool(int)>& is_free) {
  std::vector<ColumnFamily> families;
  std::map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!is_free(static_cast<int>(i))) continue;
    const ParsedName reading = parse_name(names[i]);
    if (!reading.quantity) continue;
    const auto [at, fresh] = index.emplace(reading.stem, families.size());
    if (fresh)
      families.push_back(
          {*reading.quantity, reading.fitness, reading.as_torque, {}, reading.number.has_value()});
    ColumnFamily& family = families[at->second];
    family.fitness = std::max(family.fitness, reading.fitness);
    family.column_of.emplace(reading.number.value_or(1), static_cast<int>(i));
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

}  // namespace faultline
