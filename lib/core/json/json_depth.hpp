// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

inline constexpr int kMostJsonNesting = 64;  ///< lists and objects within one another

/// Throws Error(input) if a JSON text nests deeper than that. To be called before parsing a text whose values
/// are converted, which uses the stack for each level.
void refuse_deep_json(std::string_view json, const std::string& where);

}  // namespace faultline
