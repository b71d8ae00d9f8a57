// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/log_event.hpp"

namespace faultline {

/// Onset, alarm and end of each fault of a diagnosis as JSON, in the order of their times; of a log without
/// faults, its verdict. Throws Error(input) when the text is no such diagnosis; `where` names it.
std::vector<LogEvent> events_of_diagnosis(const std::string& report, const std::string& where);

/// Of a file that was written by `diagnose --json`.
std::vector<LogEvent> events_of_file(const std::string& path);

}  // namespace faultline
