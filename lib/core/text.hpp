// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

// Filter for output of foreign texts (names of files and columns, cells, keys, notes): nothing in them
// rewrites a screen, turns the reading direction or fills pages. Errors, issues and the standard streams pass
// through it; tests/house_test.cpp checks that for the sources.
namespace faultline {

/// Returns the bytes of the character at `i` of valid UTF-8 if it commands a terminal or the reading
/// direction: control characters, including line breaks and tabs, and marks of direction; else 0.
std::size_t command_length(std::string_view valid, std::size_t i);

/// Returns one line that is safe on a terminal: valid UTF-8, line breaks and tabs as spaces, other commands
/// (an escape in a file name could rewrite the screen) as "?".
std::string printable(std::string_view text);

/// Most characters of a foreign name, as of a column, in a table or a sentence.
inline constexpr std::size_t kLongestName = 60;

/// Returns printable(); of more than `most` characters only the first and the last, and their number.
std::string shortened(std::string_view text, std::size_t most);

/// Returns a sentence that quotes foreign texts, shortened() to 4000 characters, each word to 500.
std::string brief(std::string_view text);

/// Returns lines for a terminal: as printable(), but with line breaks, and the codes of painted() if `color`.
std::string outgoing(std::string_view text, bool color);

/// Returns words in lines of at most `width` characters, each line after `indent` and ended; a longer word
/// stands alone.
std::string wrapped(const std::string& text, const std::string& indent, int width);

/// Returns "1 log", "3 logs".
std::string counted(long long count, std::string_view what);

/// Returns the text with each byte that is not part of valid UTF-8 replaced by U+FFFD. File names and
/// operators' notes can contain any bytes; stored, compared and printed JSON and XML is UTF-8.
std::string valid_utf8(std::string_view text);

enum class Paint { bold, dim, red, yellow, green, bold_red, bold_green };

/// Returns `text` between terminal colour codes if `color`, else unchanged.
std::string painted(std::string_view text, Paint paint, bool color);

/// Returns text that is safe inside XML 1.0 and HTML, also in quoted attributes: valid UTF-8, the five marks
/// escaped, control characters that XML cannot contain replaced by "?".
std::string escaped_markup(std::string_view text);

}  // namespace faultline
