// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// Returns the name that `typed` probably means: the one with the fewest letters changed, added, left out or
/// swapped with their neighbour, or that begins with `typed`. Empty when no name is near.
std::string nearest_name(const std::string& typed, const std::vector<std::string>& names);

}  // namespace faultline
