// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// Creates the folder for results, with its parents, if it does not exist. Throws Error(output).
void make_folder(const std::string& folder);

}  // namespace faultline
