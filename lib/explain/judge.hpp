// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lib/explain/search.hpp"

namespace faultline {

/// The log explained by one more fault, sizes and effects at their best and integrated out. `claim.size` is
/// where the size of a sensor fault begins. Empty where the hypothesis cannot be judged, such as a lock in
/// the last few rows.
std::optional<FaultHypothesis> judge(const LogFit& fit, const FaultClaim& claim);

}  // namespace faultline
