// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lib/log/log_source.hpp"
#include "lib/residual/relation/signal_relation.hpp"

namespace faultline {

/// A stretch of a healthy log that is left out together.
struct Fold {
  int log = 0;
  std::int64_t begin = 0, end = std::numeric_limits<std::int64_t>::max();  ///< rows
};

/// The healthy logs, or pieces of them where they are few. Rewinds them.
std::vector<Fold> folds_of(std::span<LogSource* const> logs);

/// Fits weights by least squares over all folds, and limits to the residuals of each with the weights of the
/// others. `relation` has kind, joint, target, inputs, lags and period; false where it does not hold.
bool fit(std::span<LogSource* const> logs, const std::vector<Fold>& folds, double alarms_per_hour,
         SignalRelation& relation);

/// How far a fitted relation strays over a middle window: says how good it is.
double middle_straying(const SignalRelation& relation);

/// The largest torque of the healthy logs; of a position or velocity, what it ranges over. In the target's
/// unit.
double target_scale(const SignalRelation& relation);

}  // namespace faultline
