// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/compare/compare_runs.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// A log as it is compared.
struct ReadRun {
  RunSignals signals;
  std::optional<std::string> note;  ///< how the log was changed, in a sentence
};

/// Reads a whole log; with a model (else null) with its residuals, at the rate of the model. Throws
/// Error(input) for a log that cannot be resampled or is too short.
ReadRun read_run(LogSource& log, const Model* model);
/// Whether each joint of a model is revolute.
std::vector<char> turns_of(const Model& model);

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
