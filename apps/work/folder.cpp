// SPDX-License-Identifier: MIT
#include "apps/work/folder.hpp"

#include <filesystem>

#include "lib/core/error.hpp"

namespace faultline {

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw Error(ErrorCode::output, folder,
                "cannot be created as a folder for the results; give another with -o");
}

}  // namespace faultline
