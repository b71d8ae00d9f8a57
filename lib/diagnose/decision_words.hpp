// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/diagnose/decision.hpp"

namespace faultline {

/// Why it was decided so, one sentence for a person.
std::string reason_in_words(const Decision& decision, const DecisionBasis& basis);

/// What similar cases hold against the decision, a sentence each.
std::vector<std::string> warnings_of_cases(const Decision& decision, const Votes& votes,
                                           const DecisionOptions& options = {});

}  // namespace faultline
