// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lib/explain/hypothesis.hpp"

namespace faultline {

/// A hypothesis by which rows of a joint say nothing while it lasts: a lock, a stuck encoder, an unknown
/// force. Empty where too few rows are left to say that a joint stands or that its encoder sticks.
std::optional<FaultHypothesis> judge_silent(const LogFit& fit, const FaultClaim& claim);

}  // namespace faultline
