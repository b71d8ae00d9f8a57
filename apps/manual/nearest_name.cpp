// SPDX-License-Identifier: MIT
#include "apps/manual/nearest_name.hpp"

#include <algorithm>
#include <cstddef>

namespace faultline {
namespace {

/// Returns the optimal string alignment distance.
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      edits[i][j] = i + j;
      if (i == 0 || j == 0) continue;
      edits[i][j] = std::min(
          {edits[i - 1][j] + 1, edits[i][j - 1] + 1, edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  return edits.back().back();
}

}  // namespace

std::string nearest_name(const std::string& typed, const std::vector<std::string>& names) {
  constexpr std::size_t kLettersAnEdit = 3;  // so that short words are near to few names
  std::string nearest;
  std::size_t fewest = typed.size() / kLettersAnEdit + 1;
  for (const std::string& name : names) {
    const bool begun = typed.size() >= kLettersAnEdit && name.starts_with(typed);
    const std::size_t edits = begun ? 0 : edits_between(typed, name);
    if (edits <= fewest && (nearest.empty() || edits < fewest)) {
      nearest = name;
      fewest = edits;
    }
  }
  return nearest;
}

}  // namespace faultline
