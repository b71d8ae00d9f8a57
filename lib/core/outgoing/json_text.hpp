// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace faultline {

/// A JSON report as text, indented by two blanks, ended by a line break. What commands a terminal or the
/// reading direction is written as \uXXXX, which says the same and does nothing; what is no UTF-8 as U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);

/// The same for text that is JSON already, such as one line of it.
std::string inert_json(const std::string& json);

}  // namespace faultline
