// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace faultline {

/// Tells without reading a file whether it was written to meanwhile.
struct FileStamp {
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type written{};

  bool operator==(const FileStamp&) const = default;
};

/// Of a file that is not there: one that no file has.
FileStamp stamp_of(const std::string& path);

}  // namespace faultline
