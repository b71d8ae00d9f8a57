// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/toml/toml_table.hpp"

namespace faultline {

/// Smallest change of each kind that is reported as a fault ([least_size] of the robot file), as a share of
/// the usual value of the joint or the robot (usual_of()); 0 reports any size. The defaults are those of the
/// catalogue (FaultDescription::least_size).
struct LeastSizes {
  std::array<double, kFaultKinds> share;

  LeastSizes();
  double of(FaultKind kind) const { return share[static_cast<std::size_t>(kind)]; }
  bool operator==(const LeastSizes&) const = default;
};

/// Reads [least_size]; absent keys keep their defaults. Fails as TomlTable does.
LeastSizes least_sizes_from_table(const TomlTable& table);
/// Returns the section [least_size]; "" if all sizes have their defaults.
std::string least_sizes_text(const LeastSizes& sizes);

}  // namespace faultline
