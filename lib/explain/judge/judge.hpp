// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lib/explain/hypothesis.hpp"

namespace faultline {

/// Judges a further fault: explains the log with the best sizes and effects and integrates them out.
/// `claim.size` is the initial size of a sensor fault; it is not settled for a hypothesis that explains far
/// less than another one, by `rival` nats. Empty if the hypothesis cannot be judged, such as a lock in the
/// last few rows.
std::optional<FaultHypothesis> judge(const LogFit& fit, const FaultClaim& claim, double rival = 0.0);

/// Judges a false position (FaultKind::sensor_bias or sensor_drift) that the velocity shows, too, or does not
/// if it is measured independently. `claim.size` and `rival` as for judge().
FaultHypothesis judge_false_position(const LogFit& fit, FaultClaim claim, double rival = 0.0);

/// Returns the columns of a fault that has a size, with the prior variance of its sizes; those of a false
/// reading are linearised about size zero.
FaultColumns columns_about_healthy(const LogFit& fit, const FaultClaim& claim);

/// Returns the nats of a torque loss beside effects of the day that shrink the modelled torque of its joint
/// to a share of it: a drive with less torque that moves a lighter robot with less friction. The loss scales
/// the measured torque alike, so that every residual shrinks, whatever it is. Each row from onset to end
/// costs the logarithm of the share (equation (14) of docs/how-it-works.md), but no more than a row with a
/// torque of its own (free_row_price()). 0 for other kinds.
double price_of_shrinking(const LogFit& fit, const FaultClaim& claim, const Explanation& explanation);

/// Judges a drive that limits its torque, which is of no known kind and looks like the loss of a share of the
/// torque: at joint, onset and end of the claim, with the limit that explains the log best.
FaultHypothesis judge_clipped(const LogFit& fit, FaultClaim claim);

}  // namespace faultline
