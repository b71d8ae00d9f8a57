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

}  // namespace faultline
