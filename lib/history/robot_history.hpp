// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/history/history_record.hpp"
#include "lib/wear/robot_wear.hpp"

namespace faultline {

/// A finding of a robot, with its log.
struct WorstFinding {
  HistoryFinding finding;
  std::string log;
  double start_s = std::numeric_limits<double>::quiet_NaN();  ///< of the log
};

/// One robot of a history: all results with its current model, that of its last log.
struct RobotHistory {
  std::string robot;
  int logs = 0, healthy = 0, faulty = 0, inconclusive = 0;
  int of_other_models = 0;  ///< results with earlier models, which count from other zeros
  std::string last_log;     ///< the latest by date if all logs have one, else the last that was added
  double last_start_s = std::numeric_limits<double>::quiet_NaN();
  std::optional<WorstFinding> worst;  ///< the one of the largest confidence, of these the latest
  RobotWear wear;
};

/// Returns the robots by name; `selected` names those that are wanted, all if it is empty. Throws
/// Error(usage) for a name that no result has.
std::vector<RobotHistory> robot_histories(const std::vector<HistoryRecord>& records,
                                          const std::vector<std::string>& selected);

/// "locked, joint 2 at 0.93 (2026-03-04, runs/17.csv)", or "none".
std::string worst_words(const RobotHistory& robot);

/// Lines for a terminal.
std::string to_text(const std::vector<RobotHistory>& robots);
/// Schema "faultline/history/1".
std::string history_json(const std::vector<RobotHistory>& robots);
/// One page without scripts: a line a robot, then the condition of each.
std::string history_page(const std::vector<RobotHistory>& robots);

}  // namespace faultline
