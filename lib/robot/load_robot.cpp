// SPDX-License-Identifier: MIT
#include <filesystem>

#include "lib/core/atomic_file.hpp"
#include "lib/core/error.hpp"
#include "lib/core/files/open_ending.hpp"
#include "lib/robot/robot_file.hpp"
#include "lib/robot/urdf/urdf.hpp"

namespace faultline {
namespace {

/// Whether the text begins with "<", as no TOML does.
bool is_xml(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '<';
}

}  // namespace

Robot load_robot_file(const std::string& name, const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) {
    if (is_order_of_axes(name)) return preset_robot(name);
    if (name.find_first_of("./") == std::string::npos)
      throw Error(ErrorCode::input, path,
                  "is not a file; expected a robot file, or the axes alone as letters R and P, base to tip, "
                  "such as RRP");
  }
  if (has_urdf_name(path)) return load_urdf_file(path);
  const std::string text = read_file(path);
  if (is_xml(text)) return robot_from_urdf(text, path);
  refuse_open_number(text, path);
  return robot_from_toml(text, path);
}

std::string robot_text_for(const std::string& path, const Robot& robot) {
  return has_urdf_name(path) ? urdf_text(robot) : robot_file_text(robot);
}

}  // namespace faultline
