// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// From the doctype to </head>: title, styles, and a policy that allows nothing but them and, with
/// `with_script`, the scripts of assets.hpp.
std::string html_head(const std::string& title, bool with_script);

}  // namespace faultline
