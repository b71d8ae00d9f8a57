// SPDX-License-Identifier: MIT
#pragma once

#include "lib/diagnosis/report_details.hpp"
#include "lib/pipeline/diagnose.hpp"

namespace faultline {

/// What a page shows besides the diagnosis that diagnose() made of this log with this model and options.
/// Reads the log a second time, from its first row.
ReportDetails report_details(LogSource& log, const Model& model, const Diagnosis& diagnosis,
                             const DiagnoseOptions& options = {});

}  // namespace faultline
