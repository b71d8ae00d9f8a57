// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

// The gate for what others wrote (names of files and columns, cells, keys, notes) on its way out: nothing of
// it rewrites a screen, turns the reading direction or fills pages. Errors, issues and the standard streams
// pass through it; tests/house_test.cpp holds the sources to that.
namespace faultline {

/// Bytes of the character at `i` of valid UTF-8 when it commands a terminal or the reading direction instead
/// of being seen: control characters, line breaks and tabs among them, and marks of direction; else 0.
std::size_t command_length(std::string_view valid, std::size_t i);

/// One line that is safe on a terminal: valid UTF-8, line breaks and tabs as spaces, other commands (an
/// escape in a file name could rewrite the screen) as "?".
std::string printable(std::string_view text);

/// Characters of a name of others, as of a column, in a table or a sentence of ours.
inline constexpr std::size_t kLongestName = 60;

/// printable(), and of more than `most` characters only the first and the last, with their number between.
std::string shortened(std::string_view text, std::size_t most);

/// A sentence of ours that quotes others: shortened() to 4000 characters, each word to 500.
std::string brief(std::string_view text);

/// Whole lines for a terminal: as printable(), but line breaks stay, and the codes of painted() when `color`.
std::string outgoing(std::string_view text, bool color);

/// Words broken into lines of at most `width` characters, each line after `indent` and ended; a longer word
/// stands alone.
std::string wrapped(const std::string& text, const std::string& indent, int width);

/// "1 log", "3 logs".
std::string counted(long long count, std::string_view what);

}  // namespace faultline
