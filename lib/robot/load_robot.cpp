// SPDX-License-Identifier: MIT
#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/robot/robot_file.hpp"

namespace faultline {

Robot load_robot_file(const std::string& name, const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    if (is_order_of_axes(name)) return preset_robot(name);
    if (name.find_first_of("./") == std::string::npos)
      throw Error(ErrorCode::input, path,
                  "is no file; expected a robot file, or the axes alone as letters R and P, base to tip, "
                  "such as RRP");
  }
  return robot_from_toml(read_file(path), path);
}

}  // namespace faultline
