// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

/// The text with every byte that is not part of valid UTF-8 replaced by U+FFFD. File names and operators'
/// notes can hold any bytes; what is stored, compared and printed as JSON or XML is UTF-8.
std::string valid_utf8(std::string_view text);

}  // namespace faultline
