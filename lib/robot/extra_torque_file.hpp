// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/robot/chain.hpp"
#include "lib/robot/toml/toml_table.hpp"

/// The tables [[ripple]] and [[shared_drive]] of a robot file.
namespace faultline {

/// Returns the chain with the ripples and shared drives of the tables added.
Chain read_extra_torque(const TomlTable& table, Chain chain);

/// Returns the tables as text, under `prefix` ("" or "identified."); "" if the chain has neither.
std::string extra_torque_text(const Chain& chain, const std::string& prefix);

}  // namespace faultline
