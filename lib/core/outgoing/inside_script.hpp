// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// Returns JSON that is safe in a script of a page: no "</script>" or "<!--" in it can end or open anything.
std::string inside_script(const std::string& json);

}  // namespace faultline
