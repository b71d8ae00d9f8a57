// SPDX-License-Identifier: MIT
#include "lib/batch/file_stamp.hpp"

namespace faultline {

FileStamp stamp_of(const std::string& path) {
  std::error_code error;  // then both values are such as no file has
  return {std::filesystem::file_size(path, error), std::filesystem::last_write_time(path, error)};
}

}  // namespace faultline
