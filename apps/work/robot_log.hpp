// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "formats/open_log.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/raw_reader.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Opens a log of this robot for learning or diagnosis: columns have the meaning of the robot file, others
/// are skipped, and coupled drives are converted to joints. Throws as open_log() does.
std::unique_ptr<LogSource> open_robot_log(const std::string& path, const Robot& robot,
                                          const LogSelection& parts = {});

/// Does the same for a log that is open as columns; `run` selects a run between restarts of its clock.
std::unique_ptr<LogSource> robot_log_of(std::unique_ptr<RawReader> reader, const Robot& robot,
                                        int run = kEveryRun);

}  // namespace faultline
