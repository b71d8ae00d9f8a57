// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"
#include "lib/diagnose/diagnose_options.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/diagnose/stop/stop_answer.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Answers what happened before a stop from the rows up to it alone: what follows it, such as the brakes, has
/// no influence on findings, signs and signals. `diagnosis` is that of the whole log; `judged` are the rows
/// that were judged; they are read once more from the first one to the stop. Throws Error(usage) if the
/// moment lies outside of the log.
StopAnswer explain_stop(LogSource& judged, const Model& model, const CaseBase& cases,
                        const DiagnoseOptions& options, const Diagnosis& diagnosis);

}  // namespace faultline
