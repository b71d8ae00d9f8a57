// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

/// One line that is safe on a terminal: valid UTF-8, line breaks and tabs as spaces, other control characters
/// (an escape in a file name could rewrite the screen) as "?".
std::string printable(std::string_view text);

/// Words broken into lines of at most `width` characters, each line after `indent` and ended; a longer word
/// stands alone.
std::string wrapped(const std::string& text, const std::string& indent, int width);

/// "1 log", "3 logs".
std::string counted(long long count, std::string_view what);

}  // namespace faultline
