// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// JSON as it may stand in a script of a page: no "</script>" and no "<!--" in it can end or open anything.
std::string inside_script(const std::string& json);

}  // namespace faultline
