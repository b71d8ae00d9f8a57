// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace faultline {

/// What a unit measures; `none` for no unit, which may be any.
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
  double factor = 1.0;  ///< to SI
  Dimension dimension = Dimension::none;
};

/// Nullopt for a unit that is not known.
std::optional<Unit> known_unit(std::string_view unit);

/// The factor from `unit` to SI (rad, m, s, N m, N, A and their rates): "deg" gives pi/180, "" and "-"
/// give 1. Capitals matter only for prefixes ("mm"); nullopt for a unit that is not known.
std::optional<double> si_factor(std::string_view unit);

/// "ms", "us" or "ns" for a time that is so large that it can only count in that unit from 1970; "" for any
/// other.
const char* epoch_unit(double time);

/// Separates a unit written behind a name, as in "q1 [deg]", "q1 (deg)" or "time_ms"; unit is empty when
/// there is none. After an underscore only units count that hardly mean anything else there.
struct NameAndUnit {
  std::string name;
  std::string unit;
};
NameAndUnit split_unit(std::string_view text);

}  // namespace faultline
