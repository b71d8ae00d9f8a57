// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/manual/command_description.hpp"

namespace faultline {

/// The command and all below it, each before those below it.
std::vector<const CommandDescription*> all_commands(const CommandDescription& command);

/// Those below the program that stay in effect for the words behind them: `help` does not, whose words name
/// another command.
std::vector<const CommandDescription*> commands_with_words(const CommandDescription& program);

/// What the argument of a command may be, where there are few.
std::vector<std::string> argument_choices(const CommandDescription& command);

/// The options of a command with what every command knows: those of `program`.
std::vector<ArgumentDescription> options_known_to(const CommandDescription& command,
                                                  const CommandDescription& program);

}  // namespace faultline
