// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace faultline {

enum class Paint { bold, dim, red, yellow, green };

/// `text` between terminal colour codes when `color`, else as it is.
std::string painted(const std::string& text, Paint paint, bool color);

/// One line that is safe on a terminal: valid UTF-8, line breaks and tabs as spaces, other control characters
/// (an escape in a file name could rewrite the screen) as "?".
std::string printable(std::string_view text);

/// Words broken into lines of at most `width` characters, each line after `indent` and ended; a longer word
/// stands alone.
std::string wrapped(const std::string& text, const std::string& indent, int width);

/// "4.210 s", with decimals that show single samples of that period; "unknown" for NaN.
std::string time_text(double time_s, double sample_period_s);

/// Where axes of time begin to count: 0, or the whole second of a start that is so large (seconds since 1970)
/// that ticks would not show the digits that differ.
double time_zero(double start_s);

/// Three significant digits; "-" for NaN.
std::string value_text(double value);

}  // namespace faultline
