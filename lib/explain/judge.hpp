// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lib/explain/search.hpp"

namespace faultline {

/// The log explained by one fault from `onset_s` on, sizes and effects of the day at their best and
/// integrated out. `start` is the size of a sensor fault to begin with. Empty where the hypothesis cannot be
/// judged, such as a lock in the last few rows.
std::optional<FaultHypothesis> judge(const LogFit& fit, const std::vector<LinearFault>& linear,
                                     FaultKind kind, int joint, double onset_s, double start = 0.0);

}  // namespace faultline
