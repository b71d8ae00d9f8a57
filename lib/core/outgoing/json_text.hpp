// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace faultline {

/// Returns a JSON report as text, indented by two blanks, with a line break at its end. Characters that
/// command a terminal or the reading direction become the equivalent \uXXXX, invalid UTF-8 becomes U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);

/// The same for text that is JSON already, such as one line of it.
std::string inert_json(const std::string& json);

/// Returns JSON that is safe in a script of a page: no "</script>" or "<!--" in it can end or open anything.
std::string inside_script(const std::string& json);

}  // namespace faultline
