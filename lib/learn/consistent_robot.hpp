// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/explain/explain_log.hpp"
#include "lib/learn/healthy_robot.hpp"

namespace faultline {

/// A healthy robot with a model that explains logs, and the explanation of each of its logs by a robot
/// learned from the others.
struct ExplainedRobot {
  HealthyRobot robot;                      ///< `given` names all logs, also those left out
  std::vector<UniformLog> logs{};          ///< robot.days, on a grid
  std::vector<LogExplanation> left_out{};  ///< of each log, by a robot learned from the others
  /// Contradictions between logs that were kept, in sentences; empty if there are none.
  std::vector<std::string> doubts{};
};

struct ExplainedRobotOptions {
  IdentifyOptions identify{};
  double limit_shift = 0.0;  ///< nats added to the evidence limits that healthy logs give; may be negative
  int threads = 0;           ///< 0 = one a core; the result does not depend on it
};

/// Learns healthy_robot(), the evidence limits and the window length. `logs` outlive the result. Throws
/// Error(input) when they do not suffice.
ExplainedRobot explained_robot(std::span<LogSource* const> logs, const Robot& robot,
                               const ExplainedRobotOptions& options, const Progress& progress = {});

/// Learns explained_robot() from logs that were given as healthy, and checks that they are: the log with the
/// strongest evidence of a fault is judged by a robot learned from the others, and left out if that finds a
/// fault in it; then the next. At most a minority is left out. With IdentifyOptions::keep_all, and for two
/// logs, either of which may be the faulty one, all are kept and the contradiction is a doubt. `logs` outlive
/// the result. Throws Error(input) when they do not suffice.
ExplainedRobot consistent_robot(std::span<LogSource* const> logs, const Robot& robot,
                                const ExplainedRobotOptions& options, const Progress& progress = {});

}  // namespace faultline
