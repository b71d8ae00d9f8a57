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

/// Sets a term of the friction of each joint from one number or a list. Fails for widths that are not
/// positive and, without `any_sign`, for other numbers that are negative.
void set_friction(const TomlTable& table, const std::string& key, double Friction::*member, bool any_sign,
                  Chain& chain);

/// Returns the chain with the ripples and shared drives of [[ripple]] and [[shared_drive]] added.
Chain read_extra_torque(const TomlTable& table, Chain chain);
/// Returns these tables, under `prefix` ("" or "identified."); "" if the chain has neither.
std::string extra_torque_text(const Chain& chain, const std::string& prefix);

/// Returns [known], [payload], [log], [log.columns], [normal] and [least_size].
std::string facts_text(const Robot& robot);

/// Reads the [log] section of a robot with `joints` joints. Throws Error(usage) naming the key.
LogMeaning log_meaning_from_table(const TomlTable& log, int joints);

}  // namespace faultline
