// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// Undoes that a test run under nohup, or behind a shell's &, ignores signals, which a child inherits.
void heed_signals();

/// Starts the built program `faultline` and sends it the signal after a while. Whether that ended it; false
/// when it had ended before.
bool ended_by(int signal, double seconds, const std::vector<std::string>& arguments);

}  // namespace faultline
