// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace faultline {

/// Where bytes for an output path go.
struct OutputPlace {
  std::string path;      ///< behind all symbolic links; the file need not exist
  bool special = false;  ///< a pipe or a device, or an open file: it is written straight, never replaced
  int descriptor = -1;   ///< of this process, as of /dev/stdout or /dev/fd/3; -1: none
};

/// Follows symbolic links, also those that lead to nothing yet. Throws Error(output) for links without end
/// and for those that the system does not let anybody follow.
OutputPlace output_place(const std::string& path);

/// The same for two paths exactly when they lead to the same file: device and inode, and for what does not
/// exist yet the folder's and the name below it. Empty for pipes and devices, which many may share.
std::string file_identity(const std::string& path);

/// Absolute, behind all links, without . and .. and without a slash at its end.
std::string real_path(const std::string& path);

}  // namespace faultline
