// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/explain_log.hpp"

namespace faultline {

/// A log and its faults: each is looked for with those that were found before as known; then each is judged
/// again with all others known, and is left out where they explain the log without it. `lasting` are faults
/// that an earlier part of the log has shown, see followed(). `signals`: see explain_whole_log().
ExplainedLog explain_faults(const UniformLog& log, const BalanceModel& model, const EvidenceLimits& limits,
                            const std::vector<FaultClaim>& lasting = {}, const SignalStretches& signals = {});

}  // namespace faultline
