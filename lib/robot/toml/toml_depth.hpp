// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace faultline {

/// A position in a text; line and column count from 1.
struct DeepPlace {
  int line = 1;
  int column = 1;
};

inline constexpr int kMostTomlNesting = 16;  ///< brackets within brackets, or dots in one key

/// Returns the first position at which a TOML text nests brackets, or has dots in one key, deeper than
/// kMostTomlNesting; empty if there is none. Call it before parsing: the TOML library recurses for each level
/// of a key.
std::optional<DeepPlace> too_deep(std::string_view toml);

}  // namespace faultline
