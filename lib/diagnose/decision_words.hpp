// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/decision.hpp"

namespace faultline {

/// Returns the reason for a decision, in one sentence.
std::string reason_in_words(const Decision& decision, const DecisionBasis& basis);

/// Lists what contradicts the decision among similar cases, a sentence each.
std::vector<std::string> warnings_of_cases(const Decision& decision, const Votes& votes);

}  // namespace faultline
