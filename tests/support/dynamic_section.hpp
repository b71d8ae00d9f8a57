// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace faultline {

/// What a program or module asks of the dynamic loader, as `readelf` of binutils, which g++ needs, prints it.
struct DynamicSection {
  std::vector<std::string> libraries;       ///< names, such as libc.so.6
  std::vector<std::string> search_folders;  ///< parts of RPATH and RUNPATH; empty is the current folder
};

/// Throws std::runtime_error when the file cannot be read.
DynamicSection dynamic_section(const std::string& binary);

/// Those search folders whose meaning depends on the folder that the program is started in.
std::vector<std::string> relative_search_folders(const std::string& binary);

}  // namespace faultline
