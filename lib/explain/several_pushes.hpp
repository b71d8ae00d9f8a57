// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "lib/explain/decide_log.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

/// Explains a log by at most `most` pushes alone, if their evidence together exceeds `needed` nats and they
/// leave no large misfit; else returns none. Each is the best one beside those before it and exceeds the
/// limit of a collision. The faults that `fit` knows stay, and its noise counts for all.
std::vector<ExplainedFault> several_pushes(const LogFit& fit, const EvidenceLimits& limits, std::size_t most,
                                           double needed);

}  // namespace faultline
