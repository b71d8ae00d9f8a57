// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Files below a folder that may be of foreign origin: a folder of golden logs, the results of a batch. Such a
// folder can contain links, pipes and devices. Through a link a file elsewhere would be shown or overwritten,
// and a pipe or a device may never end. The folder itself may be a link; below it only real folders and
// regular files are used, and everything else is refused without opening it.
namespace faultline {

/// Whether the file exists. Throws Error(input) if something other than a regular file, or a link on the way
/// to it, is in its place.
bool has_inner_file(const std::string& folder, const std::string& path);

/// The same for a folder below the folder.
bool has_inner_folder(const std::string& folder, const std::string& path);

/// Returns the bytes. Throws Error(input) as has_inner_file() and read_file().
std::string read_inner_file(const std::string& folder, const std::string& path,
                            std::size_t most_bytes = std::size_t{1} << 30);

/// Creates the folders on the way to a file that is to be written. Throws Error(output) if a link, or
/// something other than a regular file, is in the place of the file.
void prepare_inner_file(const std::string& folder, const std::string& path);

/// Calls write_file() after prepare_inner_file().
void write_inner_file(const std::string& folder, const std::string& path, std::string_view bytes);

/// Whether it can only be a name in a folder: neither empty nor "." nor "..", without '/' and control
/// characters.
bool is_plain_name(std::string_view name);

/// Whether it leads to a place below the folder in which it starts: plain names with '/' between them.
bool is_plain_path(std::string_view path);

/// Whether the name of a log, which is only shown, is_plain_path(); a line break or tab is allowed, as
/// printable() replaces them.
bool is_plain_log_name(std::string_view name);

}  // namespace faultline
