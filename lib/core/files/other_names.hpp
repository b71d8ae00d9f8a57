// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// Whether an open file has several names (hard links): writing to it changes it under all of them.
bool has_other_names(int descriptor);

/// Throws Error(output) if a file that is changed in place has several names; a missing file has none.
void refuse_other_names(const std::string& path);

}  // namespace faultline
