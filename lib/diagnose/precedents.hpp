// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/diagnose/decision_basis.hpp"
#include "lib/diagnose/diagnosis.hpp"
#include "lib/model/model.hpp"

namespace faultline {

/// The cases that a report shows beside an episode: those that voted, and near ones that were not simulated;
/// first what was confirmed in the field, then labelled logs, diagnosed and simulated cases, of each the most
/// similar first. Says of each what agrees and what does not.
std::vector<Precedent> precedents_of(const DecisionBasis& basis, const CaseBase& cases, const Model& model);

}  // namespace faultline
