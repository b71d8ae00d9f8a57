// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/learn/explained_robot.hpp"

namespace faultline {

/// A robot learned from healthy logs that do not contradict each other.
struct ConsistentRobot {
  ExplainedRobot explained;  ///< `given` names all logs, also those left out
  /// Contradictions between logs that were kept, in sentences; empty if there are none.
  std::vector<std::string> doubts;
};

/// Learns explained_robot() from logs that were given as healthy, and checks that they are: the log with the
/// strongest evidence of a fault is judged by a robot learned from the others, and left out if that finds a
/// fault in it; then the next. At most a minority is left out. With IdentifyOptions::keep_all, and for two
/// logs, either of which may be the faulty one, all are kept and the contradiction is a doubt. `logs` outlive
/// the result. Throws Error(input) when they do not suffice.
ConsistentRobot consistent_robot(std::span<LogSource* const> logs, const Robot& robot,
                                 const ExplainedRobotOptions& options, const Progress& progress = {});

}  // namespace faultline
