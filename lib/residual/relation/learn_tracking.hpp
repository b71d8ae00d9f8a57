// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/residual/relation/learn_relations.hpp"
#include "lib/residual/relation/relation_fit.hpp"

namespace faultline {

/// Returns tracking relations to be fitted: of position and velocity, for joints with a logged reference.
std::vector<SignalRelation> tracking_candidates(const Log& log, double period_s);

/// Fits one of them, with the memory and the rate limit that explain the healthy logs best. Returns false if
/// the motion does not follow the reference.
bool fit_tracking(std::span<LogSource* const> logs, const std::vector<Fold>& folds, double alarms_per_hour,
                  SignalRelation& relation);

}  // namespace faultline
