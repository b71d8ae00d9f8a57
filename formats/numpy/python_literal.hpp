// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

namespace faultline {

/// A Python literal of dictionaries, lists, tuples, strings, whole numbers, True, False and None; tuples
/// become lists. Nullopt when it is no such literal, or deeper than any header.
std::optional<nlohmann::json> read_python_literal(std::string_view text);

}  // namespace faultline
