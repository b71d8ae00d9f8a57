// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/log_writer.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Returns onset, alarm and end of each fault of a diagnosis in JSON, sorted by time; for a log without
/// faults, its verdict; and the stop that was asked about, with its first sign. Throws Error(input) when the
/// file is no such diagnosis.
std::vector<LogEvent> events_of_file(const std::string& path);

/// Writes the diagnosed log as MCAP with the results of the diagnosis (docs/formats-mcap.md), by a further
/// pass over the log. Throws Error(output).
void write_recording(const std::string& path, LogSource& log, const Model& model, const Diagnosis& diagnosis);

}  // namespace faultline
