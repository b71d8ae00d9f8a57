// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/chain.hpp"
#include "lib/robot/toml/toml_table.hpp"

/// [[ripple]] and [[shared_drive]] of a robot file.
namespace faultline {

void read_extra_torque(const TomlTable& table, Chain& chain);

/// The same as text, under `prefix` ("" or "identified."); "" when the chain has none.
std::string extra_torque_text(const Chain& chain, const std::string& prefix);

}  // namespace faultline
