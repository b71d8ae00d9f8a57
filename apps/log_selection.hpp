// SPDX-License-Identifier: MIT
#pragma once

#include "formats/open_log.hpp"

namespace CLI {
class App;
}

namespace faultline {

/// Adds --join, --join-by, --then and --run, which fill `parts` before the command runs.
void add_log_selection(CLI::App& command, LogSelection& parts);

/// Returns all files of the log except its first one.
std::vector<std::string> files_of(const LogSelection& parts);

}  // namespace faultline
