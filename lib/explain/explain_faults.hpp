// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/explain_log.hpp"

namespace faultline {

/// Explains a log by its faults: searches each with those found before as known, then judges each again with
/// all others known and drops it if they explain the log without it. `lasting` are faults that an earlier
/// part of the log has shown, see followed(). `signals`: see explain_whole_log().
ExplainedLog explain_faults(const UniformLog& log, const BalanceModel& model, const EvidenceLimits& limits,
                            const std::vector<FaultClaim>& lasting = {}, const SignalStretches& signals = {});

/// Replaces faults of one joint by one fault of no known kind if a worn spot explains the log better than
/// they do together, or three and more of them nearly as well: more friction in a range of the joint's
/// positions, from the first onset on. `before` are known faults and stay. `faults` are sorted by onset.
std::vector<ExplainedFault> without_worn_spots(const UniformLog& log, const BalanceModel& model,
                                               const std::vector<FaultClaim>& before,
                                               std::vector<ExplainedFault> faults);

}  // namespace faultline
