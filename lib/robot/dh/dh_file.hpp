// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/robot.hpp"
#include "lib/robot/toml/toml_table.hpp"

/// Denavit-Hartenberg tables in a robot file: `dh` or `mdh` in each [[joint]].
namespace faultline {

/// Whether the joint's table has a row, standard or modified.
bool has_dh_row(const TomlTable& joint);
/// Sets geometry and tip from the rows when there are any. Fails when only some joints have a row, when both
/// conventions are mixed, and when something else says where joints sit, too: `axes`, axis, offset,
/// direction, lengths.
void read_dh(Robot& robot, const TomlTable& table, const std::vector<TomlTable>& joints);

}  // namespace faultline
