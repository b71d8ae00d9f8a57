// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/robot.hpp"
#include "lib/robot/toml/toml_table.hpp"

/// Readers and writers of the sections of a robot file that other files contain, too.
namespace faultline {

/// Returns the robot with [known] and [payload], and with the known values in its chain.
Robot read_known(const TomlTable& table, Robot robot);

/// Returns the robot with the identified parameters of the drives and torque columns: delay, gain, gear
/// compliance.
Robot read_drives(const TomlTable& table, Robot robot);
std::string drive_text(const Robot& robot);

/// Returns [known] and [payload]; "" if both are empty.
std::string facts_text(const Robot& robot);
/// Returns [log] and [log.columns].
std::string log_text(const LogMeaning& log);

/// Reads the [log] section of a robot with `joints` joints. Throws Error(usage) naming the key.
LogMeaning log_meaning_from_table(const TomlTable& log, int joints);

}  // namespace faultline
