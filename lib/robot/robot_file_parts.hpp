// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/robot.hpp"
#include "lib/robot/toml/toml_table.hpp"

/// Sections of a robot file that stand in other files, too, read and written.
namespace faultline {

/// [known] and [payload]; what is known is set in the chain.
void read_known(Robot& robot, const TomlTable& table);

/// What was identified of the drives and their torque columns: delay, gain, gear compliance.
void read_drives(Robot& robot, const TomlTable& table);
std::string drive_text(const Robot& robot);

/// [known] and [payload]; "" when nothing is known.
std::string facts_text(const Robot& robot);
/// [log].
std::string log_text(const LogMeaning& log);

/// The [log] section of a robot file for a robot with `joints` joints. Throws Error(usage) naming the key.
LogMeaning log_meaning_from_table(const TomlTable& log, int joints);

}  // namespace faultline
