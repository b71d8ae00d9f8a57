// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/chain.hpp"

/// Units of the quantities of a joint, by its kind.
namespace faultline {

constexpr const char* position_unit(AxisKind kind) { return kind == AxisKind::revolute ? "rad" : "m"; }
constexpr const char* velocity_unit(AxisKind kind) { return kind == AxisKind::revolute ? "rad/s" : "m/s"; }
constexpr const char* torque_unit(AxisKind kind) { return kind == AxisKind::revolute ? "N m" : "N"; }
constexpr const char* viscous_unit(AxisKind kind) {
  return kind == AxisKind::revolute ? "N m s/rad" : "N s/m";
}

/// Returns for each joint whether it is prismatic.
inline std::vector<bool> sliding_joints(const Chain& chain) {
  std::vector<bool> slides;
  for (const auto& joint : chain.geometry) slides.push_back(joint.kind == AxisKind::prismatic);
  return slides;
}

}  // namespace faultline
