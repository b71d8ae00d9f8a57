// SPDX-License-Identifier: MIT
#include "lib/log/columns/unit_fit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lib/core/error.hpp"
#include "lib/core/text.hpp"

namespace faultline {
namespace {

const char* units_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::time:
      return "s";
    case Quantity::q:
    case Quantity::q_ref:
      return "rad or m";
    case Quantity::dq:
    case Quantity::dq_ref:
      return "rad/s or m/s";
    case Quantity::tau:
    case Quantity::tau_ref:
    case Quantity::tau_meas:
      return "N m or N";
  }
  return "";
}

/// Returns the quantity that a scale multiplies: one SI unit, since the factor of the unit comes first.
const char* one_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return "1";
    case Dimension::time:
      return "1 s";
    case Dimension::angle:
      return "1 rad";
    case Dimension::length:
      return "1 m";
    case Dimension::angular_speed:
      return "1 rad/s";
    case Dimension::speed:
      return "1 m/s";
    case Dimension::torque:
      return "1 N m";
    case Dimension::force:
      return "1 N";
    case Dimension::current:
      return "1 A";
    case Dimension::voltage:
      return "1 V";
    case Dimension::share:
      return "100 %";
  }
  return "";
}

}  // namespace

bool measures(Dimension dimension, Quantity quantity) {
  if (dimension == Dimension::none) return true;
  if (is_torque(quantity)) return dimension == Dimension::torque || dimension == Dimension::force;
  if (quantity == Quantity::time) return dimension == Dimension::time;
  if (quantity == Quantity::q || quantity == Quantity::q_ref)
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
                  meaning_of(channel.quantity), units_of(channel.quantity), one_of(known->dimension)));
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
