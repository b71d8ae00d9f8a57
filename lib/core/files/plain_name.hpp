// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

// Names of files that stand in a file, such as a journal or golden.toml, which may come from anybody: before
// such a name is used it is judged here.
namespace faultline {

/// Whether it can only be a name in a folder: neither empty nor "." nor "..", without '/' and control
/// characters.
bool is_plain_name(std::string_view name);

/// Whether it leads to a place below the folder that it starts in: plain names with '/' between them.
bool is_plain_path(std::string_view path);

/// is_plain_path() of a log's name that is only shown: a line break or tab may stand in it, as printable()
/// replaces them.
bool is_plain_log_name(std::string_view name);

}  // namespace faultline
