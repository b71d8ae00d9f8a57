// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace faultline {

enum class ColorChoice { automatic, always, never };

/// Whether to colour what goes to `stream`: `automatic` means on a terminal unless NO_COLOR is set to
/// something or TERM is "dumb".
bool use_color(ColorChoice choice, std::FILE* stream);
bool is_terminal(std::FILE* stream);

/// Writes a result to standard output at once, as outgoing() lets it pass: with the codes of painted() only
/// when `color`. Throws Error(output) when it cannot be written.
void print(std::string_view text, bool color = false);

/// Writes "faultline: " and the sentence, brief(), to standard error.
void tell(std::string_view sentence);

/// Before anything else: a reader that goes away and a file size limit become write errors instead of
/// signals, and closed standard streams cannot be mistaken for files opened later.
void prepare_standard_streams();

}  // namespace faultline
