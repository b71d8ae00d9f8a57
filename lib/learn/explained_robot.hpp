// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/explain/explain_log.hpp"
#include "lib/learn/healthy_robot.hpp"

namespace faultline {

/// A healthy robot with a model that explains logs, and the explanation of each of its logs by a robot
/// learned from the others.
struct ExplainedRobot {
  HealthyRobot robot;
  std::vector<UniformLog> logs{};        ///< robot.days, on a grid
  std::vector<LogExplanation> left_out;  ///< of each log, by a robot learned from the others
};

struct ExplainedRobotOptions {
  IdentifyOptions identify{};
  double limit_shift = 0.0;  ///< added to the evidence limits that healthy logs give
  int threads = 0;           ///< 0 = one a core; the result does not depend on it
};

/// Learns healthy_robot(), the evidence limits and the window length. `logs` outlive the result. Throws
/// Error(input) when they do not suffice.
ExplainedRobot explained_robot(std::span<LogSource* const> logs, const Robot& robot,
                               const ExplainedRobotOptions& options, const Progress& progress = {});

/// Returns the limits plus `nats`, which may be negative.
EvidenceLimits raised(EvidenceLimits limits, double nats);

}  // namespace faultline
