// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/robot.hpp"
#include "lib/robot/toml/toml_table.hpp"

/// Readers and writers of the sections of a robot file that other files contain, too.
namespace faultline {

/// Reads [known] and [payload], and sets the known values in the chain.
void read_known(Robot& robot, const TomlTable& table);

/// Reads the identified parameters of the drives and torque columns: delay, gain, gear compliance.
void read_drives(Robot& robot, const TomlTable& table);
std::string drive_text(const Robot& robot);

/// Returns [known] and [payload]; "" if both are empty.
std::string facts_text(const Robot& robot);
/// Returns [log] and [log.columns].
std::string log_text(const LogMeaning& log);

/// Reads the [log] section of a robot with `joints` joints. Throws Error(usage) naming the key.
LogMeaning log_meaning_from_table(const TomlTable& log, int joints);

}  // namespace faultline
