// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/arrays/stored_content.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// Returns the members of a .zip file according to its directory. If that is damaged or missing, searches
/// from the front, with an issue. Members that cannot be read are omitted and reported.
std::vector<StoredContent> zip_members(const RandomFile& file, Issues& issues);

}  // namespace faultline
