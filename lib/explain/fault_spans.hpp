// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/explain/free_form.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

/// Returns the spans of a linear fault that may come and go, such as by a loose contact: a claim for each, in
/// order, all of one size. Estimates in turn the most likely sequence of the states "present" and "absent" of
/// the rows, in which each change costs some evidence (Viterbi 1967), and the size of the fault while it is
/// present. The effects of the day are either estimated beside the fault, or those of the rows before
/// `change`, which a strong fault cannot bend: the more likely spans count. Empty if the fault is not linear.
std::vector<FaultClaim> fault_spans(const LogFit& fit, const FaultClaim& claim, const FreeForm& change);

}  // namespace faultline
