// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// The place to which the bytes for an output path are written.
struct OutputPlace {
  std::string path;      ///< behind all symbolic links; the file need not exist
  bool special = false;  ///< a pipe or a device, or an open file: it is written directly, never replaced
  int descriptor = -1;   ///< of this process, as of /dev/stdout or /dev/fd/3; -1: none
};

/// Follows symbolic links, also to targets that do not exist yet. Throws Error(output) for endless links and
/// for links that the system does not allow to follow.
OutputPlace output_place(const std::string& path);

/// Returns the same for two paths exactly if they lead to the same file: device and inode, or for a missing
/// file the folder's and the name below it. Empty for pipes and devices, which may be shared.
std::string file_identity(const std::string& path);

/// Returns the absolute path behind all links, without . and .. and without a slash at its end.
std::string real_path(const std::string& path);

/// Whether an open file has several names (hard links): writing to it changes it under all of them.
bool has_other_names(int descriptor);

/// Throws Error(output) if a file that is changed in place has several names; a missing file has none.
void refuse_other_names(const std::string& path);

}  // namespace faultline
