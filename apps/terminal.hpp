// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace faultline {

enum class ColorChoice { automatic, always, never };

/// True when output to `stream` is coloured: `automatic` means on a terminal unless NO_COLOR is set and not
/// empty, or TERM is "dumb".
bool use_color(ColorChoice choice, std::FILE* stream);
bool is_terminal(std::FILE* stream);

/// Writes a result to standard output at once after outgoing(), which keeps the codes of painted() only with
/// `color`. Throws Error(output) when it cannot be written.
void print(std::string_view text, bool color = false);

/// Writes "faultline: " and the sentence, shortened by brief(), to standard error.
void tell(std::string_view sentence);

/// Call it first: a closed pipe and a file size limit then cause write errors instead of signals, and closed
/// standard streams cannot be confused with files opened later.
void prepare_standard_streams();

}  // namespace faultline
