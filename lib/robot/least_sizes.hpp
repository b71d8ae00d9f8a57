// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "lib/fault/fault_catalogue.hpp"
#include "lib/robot/toml/toml_table.hpp"

namespace faultline {

/// How small a change of each kind may be and still be reported as a fault ([least_size] of the robot file):
/// share of what is usual for the joint or the robot (usual_of()), 0 for any size. The defaults are those of
/// the catalogue (FaultDescription::least_size).
struct LeastSizes {
  std::array<double, kFaultKinds> share;

  LeastSizes();
  double of(FaultKind kind) const { return share[static_cast<std::size_t>(kind)]; }
  bool operator==(const LeastSizes&) const = default;
};

/// [least_size]; what it leaves out keeps its default. Fails as TomlTable does.
LeastSizes least_sizes_from_table(const TomlTable& table);
/// [least_size]; "" where all is as by default.
std::string least_sizes_text(const LeastSizes& sizes);

}  // namespace faultline
