// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/manual/command_description.hpp"

namespace faultline {

/// Returns the name that `typed` probably means: the one with the fewest letters changed, added, left out or
/// swapped with their neighbour, or that begins with `typed`. Empty when no name is near.
std::string nearest_name(const std::string& typed, const std::vector<std::string>& names);

/// Returns the message for the first unknown command of a command line that needs one, or the first option
/// that its command lacks, with the nearest known one. Empty when all are known.
std::string about_unknown_word(const CommandDescription& program, const std::vector<std::string>& words);

/// Returns the message for a command with more words than it takes; empty if it has no message of its own.
std::string about_further_word(const CommandDescription& command);

}  // namespace faultline
