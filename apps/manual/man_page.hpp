// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/manual/command_description.hpp"

namespace faultline {

struct ManPage {
  std::string name;  ///< of the file: "faultline-golden-check.1"
  std::string text;  ///< roff with the man macros
};

/// Returns a page for the command and each one below it, in section 1. The pages have the program's version
/// and no date, so that the same program gives the same bytes.
std::vector<ManPage> man_pages(const CommandDescription& command);

}  // namespace faultline
