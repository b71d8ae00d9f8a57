// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/log_event.hpp"

namespace faultline {

/// Onset, alarm and end of each fault of a diagnosis that was written by `diagnose --json`, in the order of
/// their times. Throws Error(input) when the file is no such diagnosis.
std::vector<LogEvent> events_of_diagnosis(const std::string& path);

}  // namespace faultline
