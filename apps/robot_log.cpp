// SPDX-License-Identifier: MIT
#include "apps/robot_log.hpp"

#include "formats/open_log.hpp"

namespace faultline {

std::unique_ptr<LogSource> open_robot_log(const std::string& path, const Robot& robot) {
  OpenLogOptions options;
  options.columns = robot.log.columns;
  options.keep_extra = false;
  return open_log(path, options);
}

}  // namespace faultline
