// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "lib/log/log_source.hpp"
#include "lib/residual/relation/signal_relation.hpp"

namespace faultline {

/// A stretch of a healthy log that is held out at once.
struct Fold {
  int log = 0;
  std::int64_t begin = 0, end = std::numeric_limits<std::int64_t>::max();  ///< rows
};

/// Returns the healthy logs as folds, or pieces of them if they are few. Rewinds them.
std::vector<Fold> folds_of(std::span<LogSource* const> logs);

/// Returns the relation, which has kind, joint, target, inputs, lags and period, with weights by least
/// squares over all folds, and limits from the residuals of each with the weights of the others; nullopt if
/// it does not hold.
std::optional<SignalRelation> fitted(std::span<LogSource* const> logs, const std::vector<Fold>& folds,
                                     double alarms_per_hour, SignalRelation relation);

/// Standard deviation of the mean residual over the second shortest window, in the target's unit: the quality
/// of a fit.
double middle_deviation(const SignalRelation& relation);

/// Largest torque of the healthy logs; for tracking the range of position or velocity. In the target's
/// unit.
double target_scale(const SignalRelation& relation);

}  // namespace faultline
