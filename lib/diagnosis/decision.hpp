// SPDX-License-Identifier: MIT
#pragma once

#include "lib/cases/decide.hpp"
#include "lib/diagnosis/diagnosis.hpp"

namespace faultline {

/// Puts the decision on an episode that was made with `base` into a finding: label, confidence, both
/// opinions, who settled it, precedents, what it could also be (labels with at least `least_share` of the
/// votes, and the networks' other opinions), its reason and warnings as evidence lines, and the next check.
/// Times and other evidence stay.
void apply_decision(FaultFinding& finding, const Episode& episode, const CaseBase& base,
                    const CaseDecision& decision, double least_share = 0.15);

/// Adds an alternative unless it is the finding's own label or already listed; with an empty `why` the reason
/// is why_alike(), or that it came second.
void add_alternative(FaultFinding& finding, const FaultLabel& label, std::string why = "");

/// Findings by onset (then alarm, then joint) with ids from 1, and the verdict `faulty` when there is any.
void order_faults(Diagnosis& diagnosis);

}  // namespace faultline
