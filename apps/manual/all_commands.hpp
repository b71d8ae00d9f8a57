// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/manual/command_description.hpp"

namespace faultline {

/// Returns the command and all below it, each before those below it.
std::vector<const CommandDescription*> all_commands(const CommandDescription& command);

/// Returns the commands below the program that determine the meaning of the words after them; not `help`,
/// whose words name another command.
std::vector<const CommandDescription*> commands_with_words(const CommandDescription& program);

/// Returns the possible arguments of a command, if they are few words.
std::vector<std::string> argument_choices(const CommandDescription& command);

/// Returns the options of a command and those of `program` that take a value, which every command accepts.
std::vector<ArgumentDescription> options_known_to(const CommandDescription& command,
                                                  const CommandDescription& program);

}  // namespace faultline
