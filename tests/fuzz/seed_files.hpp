// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace faultline {

/// All files below tests/fuzz/seeds, in the order of their paths.
inline std::vector<std::string> seed_files() {
  std::vector<std::string> paths;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(FAULTLINE_SOURCE_DIR "/tests/fuzz/seeds"))
    if (entry.is_regular_file()) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace faultline
