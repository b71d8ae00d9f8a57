// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/explain/free_form.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

/// Nats for the absence of a fault that show its end, per mean square of the residuals.
inline constexpr double kEndEvidence = 50.0;
inline constexpr double kLeastFault_s = 0.1;  ///< after an onset, before which no end is searched
/// Shortest duration of a fault that ends, and of its absence: when a joint comes to rest, a row or two may
/// look as if the fault were gone.
inline constexpr double kLeastStay_s = 0.25;

/// Whitened residuals of a log with a fault and without it.
struct WithAndWithout {
  Stacked with, without;  ///< NaN for rows without weight
};

/// Returns the moment after `from_s` from which the log shows that a fault is gone, if any (equation (11) of
/// docs/how-it-works.md): the evidence of its absence since then (a cumulative sum; Page 1954) is large
/// compared with the residuals, and most of what its torque could give. A fault that goes on in another form
/// than its columns gives less.
std::optional<double> absent_from_s(const LogFit& fit, const WithAndWithout& left, double from_s);

/// Returns faults that lasted when the log began, as an earlier part of it has shown them, with their ends if
/// this part shows that they are gone. A false reading grows while it drifts, so its size is estimated anew;
/// other sizes stay, since this part has no rows of the healthy robot for comparison. Claims with an end stay
/// as they are.
std::vector<FaultClaim> followed(const UniformLog& log, const BalanceModel& model,
                                 std::vector<FaultClaim> lasting);

/// Returns the spans of a linear fault that may come and go, such as by a loose contact: a claim for each, in
/// order, all of one size. Estimates in turn the most likely sequence of the states "present" and "absent" of
/// the rows, in which each change costs some evidence (Viterbi 1967), and the size of the fault while it is
/// present. The effects of the day are either estimated beside the fault, or those of the rows before
/// `change`, which a strong fault cannot bend: the more likely spans count. Empty if the fault is not linear.
std::vector<FaultClaim> fault_spans(const LogFit& fit, const FaultClaim& claim, const FreeForm& change);

}  // namespace faultline
