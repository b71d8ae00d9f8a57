// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "lib/identify/identification.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/transformed/delayed_torque_source.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// How the torques of logs that were opened with one robot are read with another.
struct TorqueReading {
  std::vector<double> delay_s, gain;

  DelayedTorqueSource of(LogSource& log) const { return {log, delay_s, gain}; }
};

TorqueReading reading_of(const Robot& opened_with, const Robot& robot);

/// The logs that agree, told as if their torques acted when and as logged; `logs` outlive them.
std::deque<DelayedTorqueSource> in_time(std::span<LogSource* const> logs, const TorqueReading& reading,
                                        const std::vector<IdentifiedLog>& identified);

std::vector<LogSource*> pointers(std::deque<DelayedTorqueSource>& logs);

}  // namespace faultline
