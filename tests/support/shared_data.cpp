// SPDX-License-Identifier: MIT
#include "tests/support/shared_data.hpp"

#include <cstdio>
#include <cstdlib>

namespace faultline {

std::filesystem::path shared_data() {
  const char* told = std::getenv("FAULTLINE_SHARED_DATA");
  const std::filesystem::path folder = told ? told : FAULTLINE_SOURCE_DIR "/../shared/data";
  if (std::filesystem::is_directory(folder)) return folder;
  std::printf("passed without the recorded logs: no folder %s\n", folder.c_str());
  return {};
}

}  // namespace faultline
