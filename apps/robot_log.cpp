// SPDX-License-Identifier: MIT
#include "apps/robot_log.hpp"

#include <utility>

#include "formats/open_log.hpp"
#include "lib/log/transformed/coupled_source.hpp"
#include "lib/log/transformed/delayed_torque_source.hpp"

namespace faultline {

std::unique_ptr<LogSource> open_robot_log(const std::string& path, const Robot& robot,
                                          const LogSelection& parts) {
  OpenLogOptions options;
  options.parts = parts;
  options.columns = robot.log.columns;
  options.recording = robot.log.recording;
  options.keep_extra = false;
  std::unique_ptr<LogSource> log = coupled(open_log(path, options), robot.log.coupling);
  if (robot.torque_delay_s.empty() && robot.torque_gain.empty()) return log;
  return std::make_unique<DelayedTorqueSource>(std::move(log), robot.torque_delay_s, robot.torque_gain);
}

}  // namespace faultline
