// SPDX-License-Identifier: MIT
#pragma once

#include "lib/robot/robot.hpp"
#include "lib/robot/toml/toml_table.hpp"

namespace faultline {

/// The [log] section of a robot file for a robot with `joints` joints. Throws Error(usage) naming the key.
LogMeaning log_meaning_from_table(const TomlTable& log, int joints);

}  // namespace faultline
