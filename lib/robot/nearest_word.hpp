// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// The word of `known` nearest to `word` by edit distance, or "" if none is near enough for a misspelling.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace faultline
