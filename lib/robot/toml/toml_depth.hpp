// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

namespace faultline {

/// A place in a text where it nests deeper than any option file does; both count from 1.
struct DeepPlace {
  int line = 1;
  int column = 1;
};

inline constexpr int kMostTomlNesting = 16;  ///< brackets within brackets, and dots in one key

/// The first place where a TOML text has more brackets within brackets or dots in one key than
/// kMostTomlNesting, empty when there is none. To be asked before the text is parsed: the parser's library
/// works each level of a key on the stack.
std::optional<DeepPlace> too_deep(std::string_view toml);

}  // namespace faultline
