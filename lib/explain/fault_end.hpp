// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/explain/log_fit.hpp"

namespace faultline {

/// Nats of a fault's absence that show its end, by the mean square that is left.
inline constexpr double kEndEvidence = 50.0;
inline constexpr double kLeastFault_s = 0.1;  ///< behind an onset, before which no end is looked for
/// Of a fault that stays for a while and ends, and of the time for which it is gone: where a joint comes to
/// rest, a row or two may look as if it were.
inline constexpr double kLeastStay_s = 0.25;

/// Whitened rows of a log, explained with a fault and without it.
struct WithAndWithout {
  Stacked with, without;  ///< NaN where rows do not count
};

/// The moment after `from_s` from which the log shows that a fault is gone (equation (11) of
/// docs/how-it-works.md): the evidence of its absence since then (a cumulative sum; Page 1954) is large
/// beside what is left over, and nearly all that its torque could give. A fault that goes on in another form
/// than its columns gives less.
std::optional<double> gone_from(const LogFit& fit, const WithAndWithout& left, double from_s);

/// Faults that lasted when the log began, as an earlier part of it has shown them: with their ends where this
/// part shows that they are gone. The error of a reading grows while it drifts, so its size is estimated
/// anew; others keep theirs, since this part has no rows of the healthy robot to compare with. Claims that
/// end are left as they are.
std::vector<FaultClaim> followed(const UniformLog& log, const BalanceModel& model,
                                 std::vector<FaultClaim> lasting);

}  // namespace faultline
