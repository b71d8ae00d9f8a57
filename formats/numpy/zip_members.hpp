// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/arrays/stored_content.hpp"
#include "lib/core/issue.hpp"

namespace faultline {

/// The members of a .zip file, by its directory, or from its front on when that is damaged or missing, which
/// is told. Members that cannot be read are left out and told.
std::vector<StoredContent> zip_members(const RandomFile& file, Issues& issues);

}  // namespace faultline
