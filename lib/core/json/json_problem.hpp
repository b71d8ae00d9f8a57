// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace faultline {

/// What is wrong with a JSON text, for a person: the line and column where it is none, a number that is too
/// large, or what was expected of a value. `error` is what nlohmann::json threw at the text.
std::string json_problem(const std::exception& error, std::string_view text);

}  // namespace faultline
