// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace faultline {

/// The physical quantity of a unit; `none` for an empty unit, which fits any quantity.
enum class Dimension {
  none,
  time,
  angle,
  length,
  angular_speed,
  speed,
  torque,
  force,
  current,
  voltage,
  share
};

struct Unit {
  double factor = 1.0;  ///< factor to SI
  Dimension dimension = Dimension::none;
};

/// Returns the unit; nullopt if it is unknown.
std::optional<Unit> known_unit(std::string_view unit);

/// Returns the factor from `unit` to SI (rad, m, s, N m, N, A and their rates): "deg" gives pi/180, "" and
/// "-" give 1; nullopt for an unknown unit. Capitals do not matter.
std::optional<double> si_factor(std::string_view unit);

/// Returns "ms", "us" or "ns" for a time so large that it can only count in that unit from 1970; else "".
const char* epoch_unit(double time);

/// Separates a unit written behind a name, as in "q1 [deg]", "q1 (deg)" or "time_ms"; unit is empty if there
/// is none. After an underscore only units count that hardly mean anything else there.
struct NameAndUnit {
  std::string name;
  std::string unit;
};
NameAndUnit split_unit(std::string_view text);

}  // namespace faultline
