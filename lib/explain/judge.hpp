// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lib/explain/search/search.hpp"

namespace faultline {

/// The log explained by one more fault, sizes and effects at their best and integrated out. `claim.size` is
/// where the size of a sensor fault begins. Empty where the hypothesis cannot be judged, such as a lock in
/// the last few rows.
std::optional<FaultHypothesis> judge(const LogFit& fit, const FaultClaim& claim);

/// Columns of a fault that has a size, with the prior variance of its sizes; those of a false reading are
/// linear about a true one.
FaultColumns columns_about_healthy(const LogFit& fit, const FaultClaim& claim);

/// A drive that gives no more than a torque of some size, which is no known kind and looks like the loss of a
/// share of it: the claim's joint, onset and end, the size that explains the log best.
FaultHypothesis judge_clipped(const LogFit& fit, FaultClaim claim);

}  // namespace faultline
