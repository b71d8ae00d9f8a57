// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

inline constexpr int kMostJsonNesting = 64;  ///< lists and objects within one another

/// Throws Error(input) when a JSON text nests deeper than that. To be asked before a text is parsed whose
/// values are converted, which takes each level on the stack.
void refuse_deep_json(std::string_view json, const std::string& where);

}  // namespace faultline
