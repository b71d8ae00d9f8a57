// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/case_base.hpp"
#include "lib/diagnosis/diagnosis.hpp"
#include "lib/log/log_source.hpp"
#include "lib/pipeline/model.hpp"

namespace faultline {

/// How faults are told.
enum class ClassifyMode {
  evidence,  ///< the bank of hypotheses finds episodes, both networks judge their evidence, cases settle
  samples,   ///< the paper's: both networks over the residuals of each sample, and the fault criterion
};

struct DiagnoseOptions {
  ClassifyMode mode = ClassifyMode::evidence;
  CriterionKind criterion = CriterionKind::log_odds;  ///< of mode samples
  int g = 0;  ///< of the criterion `consecutive`; 0 = as tuned when the model was learned
};

/// Diagnoses one log: listens to it, decides each episode, and puts everything into one value. Neither model
/// nor case base is changed. Throws Error(input) when the log cannot be processed.
Diagnosis diagnose(LogSource& log, const Model& model, const CaseBase& cases,
                   const DiagnoseOptions& options = {});

}  // namespace faultline
