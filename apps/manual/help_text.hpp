// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/manual/command_description.hpp"

namespace faultline {

/// Returns "faultline convert [OPTIONS] LOG OUT".
std::string usage_of(const CommandDescription& command);

/// Returns "-o,--output DIR", "--threads N=0", "--color {auto,always,never}".
std::string title_of(const ArgumentDescription& argument);

/// Returns the text of --help, for terminals of 100 columns.
std::string help_text(const CommandDescription& command);

}  // namespace faultline
