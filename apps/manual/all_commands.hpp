// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "apps/manual/command_description.hpp"

namespace faultline {

/// The command and all below it, each before those below it.
std::vector<const CommandDescription*> all_commands(const CommandDescription& command);

/// The options of a command with what every command knows: those of `program`.
std::vector<ArgumentDescription> options_known_to(const CommandDescription& command,
                                                  const CommandDescription& program);

}  // namespace faultline
