// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/open_log.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Opens a log of this robot for learning or diagnosis: its columns mean what the robot file says, those
/// without a meaning are passed over, and coupled drives are turned into joints. Throws as open_log().
std::unique_ptr<LogSource> open_robot_log(const std::string& path, const Robot& robot,
                                          const LogSelection& parts = {});

/// The same of a log that is open as columns; `run` of it, where its clock restarts.
std::unique_ptr<LogSource> robot_log_of(std::unique_ptr<RawReader> reader, const Robot& robot,
                                        int run = kEveryRun);

}  // namespace faultline
