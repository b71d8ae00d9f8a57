// SPDX-License-Identifier: MIT
#include "lib/log/columns/unit_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

const char* units_of(Quantity quantity) {
  if (is_torque(quantity)) return "N m or N";
  if (quantity == Quantity::time) return "s";
  return basic_quantity(quantity) == Quantity::q ? "rad or m" : "rad/s or m/s";
}

/// The quantity that a scale multiplies, by Dimension: one SI unit, since the factor of the unit comes first.
constexpr std::array kOneOf{"1",     "1 s", "1 rad", "1 m", "1 rad/s", "1 m/s",
                            "1 N m", "1 N", "1 A",   "1 V", "100 %"};
static_assert(kOneOf.size() == static_cast<std::size_t>(Dimension::share) + 1);

}  // namespace

bool measures(Dimension dimension, Quantity quantity) {
  if (dimension == Dimension::none) return true;
  if (is_torque(quantity)) return dimension == Dimension::torque || dimension == Dimension::force;
  if (quantity == Quantity::time) return dimension == Dimension::time;
  if (basic_quantity(quantity) == Quantity::q)
    return dimension == Dimension::angle || dimension == Dimension::length;
  return dimension == Dimension::angular_speed || dimension == Dimension::speed;
}

double checked_factor(const ColumnSpec& spec, const std::string& channel) {
  if (spec.sign != 1.0 && spec.sign != -1.0)
    throw Error(ErrorCode::usage, "[log.columns] " + channel,
                "sign must be 1 or -1; write a factor into scale");
  if (const auto factor = si_factor(spec.unit)) return *factor;
  throw Error(ErrorCode::usage, "[log.columns] " + channel,
              "the unit \"" + shortened(spec.unit, kLongestName) + "\"" +
                  " is unknown; use one such as rad, deg, m, mm, rad/s, rpm, N m, s, ms, us, ns");
}

void refuse_misfit(const RawColumn& column, const ColumnSpec& spec, Channel channel,
                   const std::string& path) {
  const bool in_header = spec.unit.empty();
  const std::string& unit = in_header ? column.unit : spec.unit;
  const auto known = known_unit(unit);
  if (!known || measures(known->dimension, channel.quantity) || spec.scale != 1.0) return;
  throw Error(
      in_header ? ErrorCode::input : ErrorCode::usage,
      in_header ? path : "[log.columns] " + to_string(channel),
      fmt::format("column \"{0}\" is in {1}, but {2} is a {3} in {4}: state in the robot file how much {5} "
                  "is, [log.columns] {2} = {{name = \"{0}\", scale = ...}}, or state the true unit",
                  shortened(column.name, kLongestName), shortened(unit, kLongestName), to_string(channel),
                  meaning_of(channel.quantity), units_of(channel.quantity),
                  kOneOf[static_cast<std::size_t>(known->dimension)]));
}

std::vector<ColumnFamily> take_mismatched(std::vector<ColumnFamily>& families,
                                          const std::vector<RawColumn>& columns, const ColumnMap& map) {
  const auto explained = [&](Quantity quantity) {
    return std::any_of(map.begin(), map.end(), [&](const auto& entry) {
      const auto channel = canonical_channel(entry.first);
      const bool same =
          channel && (channel->quantity == quantity || (is_torque(channel->quantity) && is_torque(quantity)));
      return same && entry.second.name.empty() && (entry.second.scale != 1.0 || !entry.second.unit.empty());
    });
  };
  const auto misfit =
      std::stable_partition(families.begin(), families.end(), [&](const ColumnFamily& family) {
        const auto unit = known_unit(columns[family.column_of.begin()->second].unit);
        return !unit || measures(unit->dimension, family.quantity) || explained(family.quantity);
      });
  std::vector<ColumnFamily> taken(misfit, families.end());
  families.erase(misfit, families.end());
  return taken;
}

std::string not_taken_sentence(const RawColumn& column, Quantity quantity) {
  return fmt::format("column \"{}\" is in {}, so it was not used as {}", shortened(column.name, kLongestName),
                     shortened(column.unit, kLongestName), meaning_of(quantity));
}

}  // namespace faultline
