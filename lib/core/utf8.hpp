// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

/// Returns the text with each byte that is not part of valid UTF-8 replaced by U+FFFD. File names and
/// operators' notes can contain any bytes; stored, compared and printed JSON and XML is UTF-8.
std::string valid_utf8(std::string_view text);

}  // namespace faultline
