// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/decide_log.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

/// Replaces faults of one joint by one fault of no known kind if a worn spot explains the log better than
/// they do together, or three and more of them nearly as well: more friction in a range of the joint's
/// positions, from the first onset on. `before` are known faults and stay. `faults` are sorted by onset.
std::vector<ExplainedFault> without_worn_spots(const UniformLog& log, const BalanceModel& model,
                                               const std::vector<FaultClaim>& before,
                                               std::vector<ExplainedFault> faults);

}  // namespace faultline
