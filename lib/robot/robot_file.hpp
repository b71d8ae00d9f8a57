// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/robot.hpp"
#include "lib/robot/toml/toml_table.hpp"

namespace faultline {

/// Reads a robot file, TOML (docs/robot-file.md) or URDF (docs/urdf.md); a relative path counts from
/// `folder`. If there is no file of that name, an order of axes such as "RRP" gives preset_robot() of it.
/// Throws Error(usage) naming file, line, key, what was found and what was expected; Error(input) if the file
/// cannot be read or is no URDF of a serial chain.
Robot load_robot_file(const std::string& name, const std::string& folder = "");

/// Reads a robot from the text of a robot file; `where` names it in errors.
Robot robot_from_toml(const std::string& text, const std::string& where);

/// Reads a robot from a table inside another option file, such as [robot] of a simulation spec.
Robot robot_from_table(const TomlTable& table);

/// Returns the robot as the text of a robot file, which loads again as the same values, bit for bit. The
/// parameters of an identified robot stand in [identified].
std::string robot_file_text(const Robot& robot);

/// Returns the robot in the format of the path's extension: URDF for .urdf, a robot file for any other.
std::string robot_text_for(const std::string& path, const Robot& robot);

}  // namespace faultline
