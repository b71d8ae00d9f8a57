// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "lib/explain/decide_log.hpp"
#include "lib/explain/explain.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

/// s between two onsets at one joint that count as one.
inline constexpr double kAsOne_s = 1.0;

/// Returns the named faults of an explanation beside the known faults of `fit`, the `most` best ones at most,
/// best first: those whose evidence exceeds its limit by more than the known faults may leave of themselves.
/// They leave a residual (the limits are counted in units of it) and an error of form, and the fault beside
/// which a further one begins within kAsOne_s is not described twice.
std::vector<ExplainedFault> further_faults(const LogFit& fit, const LogExplanation& e,
                                           const EvidenceLimits& limits, std::size_t most);

}  // namespace faultline
