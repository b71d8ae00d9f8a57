// SPDX-License-Identifier: MIT
#include "apps/work/robot_log.hpp"

#include <utility>

#include "formats/open_log.hpp"
#include "lib/log/mapped_source.hpp"
#include "lib/log/recorder/corrected_source.hpp"
#include "lib/log/transformed/converted_torque_source.hpp"
#include "lib/log/transformed/coupled_source.hpp"
#include "lib/robot/chain.hpp"

namespace faultline {

std::unique_ptr<LogSource> robot_log_of(std::unique_ptr<RawReader> reader, const Robot& robot, int run) {
  MappedSourceOptions options;
  options.columns = robot.log.columns;
  options.run = run;
  options.keep_extra = false;
  options.keep_partial_velocity = false;
  std::unique_ptr<LogSource> log =
      coupled(mended(std::make_unique<MappedSource>(std::move(reader), options), sliding_joints(robot.chain)),
              robot.log.coupling);
  if (robot.torque_delay_s.empty() && robot.torque_gain.empty() && robot.torque_limit.empty()) return log;
  return std::make_unique<ConvertedTorqueSource>(
      std::move(log), TorqueConversion(robot.torque_delay_s, robot.torque_gain, robot.torque_limit));
}

std::unique_ptr<LogSource> open_robot_log(const std::string& path, const Robot& robot,
                                          const LogSelection& parts) {
  return robot_log_of(open_parts(path, parts, robot.log.recording), robot, parts.run);
}

}  // namespace faultline
