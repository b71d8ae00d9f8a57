// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lib/core/issue.hpp"
#include "lib/log/log_source.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// A log was brought to the sample period of the model before it was judged.
inline constexpr const char* kResampled = "resampled";

/// How the sample period of a log goes with that of the logs that a model was learned from.
struct LogRate {
  double period_s = 0.0;  ///< of the log; 0 where it has too few rows
  double ratio = 1.0;     ///< to the model's; exactly 1 where they differ by less than 2 %

  bool is_models() const { return ratio == 1.0; }
  /// Whether rows at the model's period can be made of it: not of a log that is much slower.
  bool can_be_resampled() const;
};

/// From the beginning of the log. Rewinds it before and after.
LogRate log_rate(LogSource& log, const Model& model);

/// That the log is judged at the model's rate, as an issue of the log.
Issue resampled_issue(const LogRate& rate, const Model& model);

/// The log at the model's rate. `log` stands at its first row and outlives it.
std::unique_ptr<LogSource> at_model_rate(LogSource& log, const Model& model);

/// The rows that were judged: those of `log`, or of the log at the model's rate where `issues` of the
/// diagnosis have kResampled. `kept` holds what is made for it; rewinds the log.
LogSource& judged_rows(LogSource& log, const Model& model, const Issues& issues,
                       std::unique_ptr<LogSource>& kept);

}  // namespace faultline
