// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/hypothesis.hpp"

namespace faultline {

/// Judges a false position (FaultKind::sensor_bias or sensor_drift) that the velocity shows, too, or does not
/// if it is measured independently. `claim.size` is the initial size.
FaultHypothesis judge_false_position(const LogFit& fit, FaultClaim claim);

/// Returns the columns of a fault that has a size, with the prior variance of its sizes; those of a false
/// reading are linearised about size zero.
FaultColumns columns_about_healthy(const LogFit& fit, const FaultClaim& claim);

}  // namespace faultline
