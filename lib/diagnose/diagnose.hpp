// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"
#include "lib/diagnose/diagnose_options.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Diagnoses one log: monitors it, decides each episode, and puts everything into one value. Neither model
/// nor case base is changed. Throws Error(input) when the log cannot be processed.
Diagnosis diagnose(LogSource& log, const Model& model, const CaseBase& cases,
                   const DiagnoseOptions& options = {});

}  // namespace faultline
