// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/identify/days/fit_days.hpp"
#include "lib/identify/identification.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/transformed/converted_torque_source.hpp"
#include "lib/model/model.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

template <typename Source>
std::vector<LogSource*> pointers(std::deque<Source>& logs) {
  std::vector<LogSource*> out;
  for (Source& log : logs) out.push_back(&log);
  return out;
}

/// A robot learned from its healthy logs, before limits and faults are.
struct HealthyRobot {
  Identification identification;
  std::vector<IdentifiedLog> given;  ///< all logs, as first identified
  TorqueConversion conversion{
      std::vector<double>{}};                       ///< of logs opened with the robot as given to its torques
  std::deque<ConvertedTorqueSource> logs;           ///< those not left out
  std::vector<LogSource*> days;                     ///< the same; a single log is cut into several days
  std::vector<std::unique_ptr<LogSource>> parts{};  ///< of a single log
  Model model;                                      ///< robot, identification, motion, rows
  std::vector<RobotRows> without{};                 ///< rows learned without each of the days
};

/// Identifies the robot and learns how its healthy days differ. If a work piece comes and goes, the robot is
/// identified a second time, from the rows without it. `logs` outlive the result. Throws Error(input) when
/// they do not suffice.
HealthyRobot healthy_robot(std::span<LogSource* const> logs, const Robot& robot,
                           const IdentifyOptions& options, const Progress& progress);

/// Learns the rows from some of the robot's days.
RobotRows rows_of(const HealthyRobot& robot, const std::vector<LogSource*>& days);

}  // namespace faultline
