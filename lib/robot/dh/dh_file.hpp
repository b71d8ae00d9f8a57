// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/robot/robot.hpp"
#include "lib/robot/toml/toml_table.hpp"

/// Denavit-Hartenberg tables in a robot file: `dh` or `mdh` in each [[joint]].
namespace faultline {

/// Whether the joint's table has a row of the standard (`dh`) or the modified (`mdh`) convention.
bool has_dh_row(const TomlTable& joint);
/// Sets geometry and tip from the rows, if there are any. Fails if only some joints have a row, if both
/// conventions are mixed, or if another key places joints too: `axes`, axis, offset, direction, lengths.
void read_dh(Robot& robot, const TomlTable& table, const std::vector<TomlTable>& joints);

}  // namespace faultline
