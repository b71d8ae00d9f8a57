// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/manual/command_description.hpp"

namespace faultline {

/// Returns the text of --help, for terminals of 100 columns.
std::string help_text(const CommandDescription& command);

struct ManPage {
  std::string name;  ///< of the file: "faultline-golden-check.1"
  std::string text;  ///< roff with the man macros
};

/// Returns a page for the command and each one below it, in section 1. The pages have the program's version
/// and no date, so that the same program gives the same bytes.
std::vector<ManPage> man_pages(const CommandDescription& command);

// Scripts by which a shell completes commands, options, and values that are few words; else files.
std::string bash_completion(const CommandDescription& program);
std::string zsh_completion(const CommandDescription& program);
std::string fish_completion(const CommandDescription& program);

}  // namespace faultline
