// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

// Checks for names of files that were read from a file, such as a journal or golden.toml, of any origin.
namespace faultline {

/// Whether it can only be a name in a folder: neither empty nor "." nor "..", without '/' and control
/// characters.
bool is_plain_name(std::string_view name);

/// Whether it leads to a place below the folder in which it starts: plain names with '/' between them.
bool is_plain_path(std::string_view path);

/// Whether the name of a log, which is only shown, is_plain_path(); a line break or tab is allowed, as
/// printable() replaces them.
bool is_plain_log_name(std::string_view name);

}  // namespace faultline
