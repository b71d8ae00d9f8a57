// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "lib/cases/carry_over.hpp"

namespace faultline {

/// Throws Error(input) when the existing case base cannot be read, or has cases added by people for joints
/// that this robot lacks: learning would lose them. Throws Error(output) when it is read-only.
void check_can_carry_over(const std::string& case_base, int joints);

/// Reports the fate of the existing cases in a sentence or two; empty if there were none.
std::string carried_text(const std::optional<CarriedCases>& carried);
nlohmann::ordered_json carried_json(const CarriedCases& carried);

}  // namespace faultline
