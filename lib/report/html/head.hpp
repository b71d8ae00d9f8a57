// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace faultline {

/// RFC 4648 with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// As Content-Security-Policy names an inline script or style: "'sha256-...'".
std::string source_hash(std::string_view content);

/// From the doctype to </head>: title, styles, and a policy that allows nothing but them and, with
/// `with_script`, its scripts.
std::string html_head(const std::string& title, bool with_script);

// Files that are put into every page, embedded when the program is built (embed_assets.cmake).
std::string_view dygraphs_script();  ///< dygraph.min.js of Debian's libjs-dygraphs
std::string_view dygraphs_style();
std::string_view page_script();
std::string_view page_style();

}  // namespace faultline
