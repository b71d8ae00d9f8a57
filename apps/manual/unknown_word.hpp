// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/manual/command_description.hpp"

namespace faultline {

/// What to say of the first word of a command line that is no command where one is wanted, or of the first
/// option that its command does not have, with the nearest that there is. Empty when all are known.
std::string about_unknown_word(const CommandDescription& program, const std::vector<std::string>& words);

/// What to say where a command was given more words than it takes; empty for a command that says nothing of
/// its own.
std::string about_further_word(const CommandDescription& command);

}  // namespace faultline
