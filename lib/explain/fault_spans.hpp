// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/log_fit.hpp"

namespace faultline {

/// When the log shows a linear fault that may come and go, such as by a loose contact: a claim for each span,
/// in order, all of one size. The states "present" and "absent" of the rows that are most likely together, of
/// which each change costs some evidence (Viterbi 1967), and the size of the fault while it is present are
/// estimated in turn. Empty where the fault is none that is linear.
std::vector<FaultClaim> fault_spans(const LogFit& fit, const FaultClaim& claim);

}  // namespace faultline
