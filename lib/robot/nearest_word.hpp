// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// The one of `known` nearest to `word` by edit distance, or "" when none is near enough to be a misspelling.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace faultline
