// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lib/cases/case_base.hpp"

namespace faultline {

/// Returns one case with its features by name; NaN is null.
nlohmann::ordered_json to_json(const CaseBase& base, const Case& c);

/// Returns the whole base as JSON text, schema "faultline/cases/1", without loss: from_cases_json() returns a
/// base with the same sha256.
std::string to_cases_json(const CaseBase& base);
/// Throws Error(input) with `where` and the position in the text.
CaseBase from_cases_json(const std::string& text, const std::string& where);

}  // namespace faultline
