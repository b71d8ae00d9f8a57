// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/diagnose/decision.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// Returns the cases that a report shows beside an episode: those that voted, and near ones that were not
/// simulated; first those confirmed in the field, then labelled, diagnosed and simulated cases, of each
/// origin the most similar first. Each lists features that agree and features that differ.
std::vector<Precedent> precedents_of(const DecisionBasis& basis, const CaseBase& cases, const Model& model);

}  // namespace faultline
