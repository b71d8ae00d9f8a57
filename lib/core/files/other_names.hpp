// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// Whether an open file has several names (hard links): what is written into it changes it under all of them.
bool has_other_names(int descriptor);

/// Throws Error(output) where a file that is changed in place has several names; none where there is no file.
void refuse_other_names(const std::string& path);

}  // namespace faultline
