// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/robot.hpp"
#include "lib/robot/toml/toml_table.hpp"

/// Axes and links of a robot file.
namespace faultline {

/// [[joint]] without `axes`: every axis from its table.
Robot chain_from_joints(const TomlTable& table, const std::vector<TomlTable>& joints);
/// Axis, offset and direction of the joints whose tables say something of them.
void read_geometry(Robot& robot, const std::vector<TomlTable>& joints);
/// [[link]]: lengths, masses and shapes, or those of a chain of which nothing is said.
void read_links(Robot& robot, const TomlTable& table);

}  // namespace faultline
