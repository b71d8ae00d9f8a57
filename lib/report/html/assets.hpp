// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

/// Files that are put into every page, embedded when the program is built (embed_assets.cmake).
namespace faultline {

std::string_view dygraphs_script();  ///< dygraph.min.js of Debian's libjs-dygraphs
std::string_view dygraphs_style();
std::string_view page_script();
std::string_view page_style();

}  // namespace faultline
