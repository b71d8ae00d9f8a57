// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/learn/explained_robot.hpp"

namespace faultline {

/// A robot learned from those logs that bear each other out.
struct TrustedRobot {
  ExplainedRobot explained;  ///< `given` names all logs, also those left out
  /// Why the logs are not to be trusted all the same, in sentences; empty where nothing speaks against them.
  std::vector<std::string> doubts;
};

/// explained_robot() of logs that were given as healthy, where no log is believed for its word: the one that
/// a fault explains most of, against the others, is judged by a robot learned from the others, and left out
/// where that names a fault in it; then the next. At most a minority is left out. With
/// IdentifyOptions::keep_all, and of two logs, where nobody can say which of both is healthy, all are kept
/// and the contradiction is a doubt. `logs` outlive the result. Throws Error(input) when they do not suffice.
TrustedRobot trusted_robot(std::span<LogSource* const> logs, const Robot& robot,
                           const ExplainedRobotOptions& options, const Progress& progress = {});

}  // namespace faultline
