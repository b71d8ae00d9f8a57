// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// The name that `typed` was most likely meant to be: the one that the fewest letters changed, added, left
/// out or exchanged with their neighbour lead to, or that it begins. Empty when none is near.
std::string nearest_name(const std::string& typed, const std::vector<std::string>& names);

}  // namespace faultline
