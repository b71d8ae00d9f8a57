// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace faultline {

/// Size, times and number of a file: a change of any shows, without reading, that the file was written to or
/// replaced. All are -1 of a file that is not there.
struct FileStamp {
  std::int64_t bytes = -1;
  std::int64_t written_ns = -1;  ///< since 1970; programs can set this time
  std::int64_t changed_ns = -1;  ///< of content or attributes; no program can set this time
  std::int64_t number = -1;      ///< in its file system (inode)

  bool operator==(const FileStamp&) const = default;
};

FileStamp stamp_of(const std::string& path);
std::vector<FileStamp> stamps_of(const std::vector<std::string>& paths);

/// Whether the files were last written to so long ago that a write after the stamp was taken, which file
/// systems with coarse clocks may give the same time, cannot be hidden.
bool are_settled(const std::vector<FileStamp>& stamps);

}  // namespace faultline
