// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/compare/compare_runs.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Two runs as they are compared.
struct ComparedLogs {
  RunComparison comparison;
  std::vector<char> turns;  ///< by joint: whether it is revolute; empty without a model
};

/// Compares two logs signal by signal; with a model (else null) by its residuals, too. A log with another
/// sample period than the model's is resampled, and a note of the comparison says so. Throws Error(input) for
/// a log that cannot be resampled, and as compare_runs() does.
ComparedLogs compare_logs(LogSource& first, LogSource& second, const Model* model, AlignmentKind align);

}  // namespace faultline
