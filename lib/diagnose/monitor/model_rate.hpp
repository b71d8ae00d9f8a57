// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/core/issue.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Code of the issue that a log was resampled to the sample period of the model before it was judged.
inline constexpr const char* kResampled = "resampled";

/// The sample period of a log compared with that of the logs that a model was learned from.
struct LogRate {
  double period_s = 0.0;  ///< of the log; 0 if it has too few rows
  double ratio = 1.0;     ///< to the model's; exactly 1 if they differ by at most 2 %

  bool is_models() const { return ratio == 1.0; }
  /// Whether the log can be resampled to the model's period: not if it is much slower.
  bool can_be_resampled() const;
};

/// Measures the rate at the beginning of the log. Rewinds it before and after.
LogRate log_rate(LogSource& log, const Model& model);

/// Makes the issue that the log is judged at the model's rate.
Issue resampled_issue(const LogRate& rate, const Model& model);

/// Returns the log at the model's rate. `log` stands at its first row and outlives it.
std::unique_ptr<LogSource> at_model_rate(LogSource& log, const Model& model);

/// Returns the rows that were judged: those of `log`, or of the log at the model's rate if `issues` of the
/// diagnosis have kResampled. `kept` then owns the resampled log. Rewinds the log.
LogSource& judged_rows(LogSource& log, const Model& model, const Issues& issues,
                       std::unique_ptr<LogSource>& kept);

}  // namespace faultline
