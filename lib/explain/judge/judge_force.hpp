// SPDX-License-Identifier: MIT
#pragma once

#include "lib/explain/fault_claim.hpp"
#include "lib/explain/hypothesis.hpp"
#include "lib/explain/log_fit.hpp"

namespace faultline {

/// Judges a push: a force from onset to end of the claim on all joints, and on the joint alone with the
/// greatest force for its torque, at which it is reported. The force acts in one direction, as a contact
/// does: what swings, such as the jump of a slipping belt, is no push. It has the first two of
/// kMeanOfForceForm, or all if the claim has any form, or one of the first two if these swing.
FaultHypothesis judge_force(const LogFit& fit, FaultClaim claim);

}  // namespace faultline
