// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

/// Returns a text as gzip (RFC 1952) in base64 (RFC 4648): what a page holds without the time to parse it
/// until a script unpacks it. The same text gives the same bytes with the same zlib.
std::string packed(std::string_view text);

}  // namespace faultline
