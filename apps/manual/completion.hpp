// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/manual/command_description.hpp"

namespace faultline {

// Scripts by which a shell completes commands, options, and values that are few words; else files.
std::string bash_completion(const CommandDescription& program);
std::string zsh_completion(const CommandDescription& program);
std::string fish_completion(const CommandDescription& program);

}  // namespace faultline
