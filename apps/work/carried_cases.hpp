// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "lib/cases/carry_over.hpp"

namespace faultline {

/// Throws Error(input) when the case base there cannot be read or changed, or when people have put cases into
/// it that a robot of so many joints cannot have: learning over it would lose them.
void check_can_carry_over(const std::string& case_base, int joints);

/// What became of the cases that were there, a sentence or two; empty where there were none.
std::string carried_text(const std::optional<CarriedCases>& carried);
nlohmann::ordered_json carried_json(const CarriedCases& carried);

}  // namespace faultline
