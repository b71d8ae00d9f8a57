// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// Makes the folder for results, with those above it, when it is not there. Throws Error(output).
void make_folder(const std::string& folder);

}  // namespace faultline
