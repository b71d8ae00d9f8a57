// SPDX-License-Identifier: MIT
#pragma once

#include "formats/open_log.hpp"

namespace CLI {
class App;
}

namespace faultline {

/// Offers --join, --join-by, --then and --run, which fill `parts` before the command runs.
void add_log_selection(CLI::App& command, LogSelection& parts);

/// All files of the log beside its first one.
std::vector<std::string> files_of(const LogSelection& parts);

}  // namespace faultline
