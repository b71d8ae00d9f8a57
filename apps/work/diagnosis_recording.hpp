// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Writes the diagnosed log as MCAP with the results of the diagnosis (docs/formats-mcap.md), by a further
/// pass over the log. Throws Error(output).
void write_recording(const std::string& path, LogSource& log, const Model& model, const Diagnosis& diagnosis);

}  // namespace faultline
