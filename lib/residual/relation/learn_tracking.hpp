// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/residual/relation/learn_relations.hpp"
#include "lib/residual/relation/relation_fit.hpp"

namespace faultline {

/// How the joints of a log may follow their references: position and velocity, where the log has both sides.
std::vector<SignalRelation> tracking_candidates(const Log& log, double period_s);

/// Fits one of them: with the memory, and the limit of how fast the target can change, that explain the
/// healthy logs best. False where the motion does not follow the reference.
bool fit_tracking(std::span<LogSource* const> logs, const std::vector<Fold>& folds, double alarms_per_hour,
                  SignalRelation& relation);

}  // namespace faultline
