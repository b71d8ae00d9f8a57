// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/explain/explain_log.hpp"
#include "lib/learn/healthy_robot.hpp"

namespace faultline {

/// A healthy robot whose model explains logs, and what it says of each log that it was learned from, where
/// that log was left out.
struct ExplainedRobot {
  HealthyRobot robot;
  std::vector<UniformLog> logs{};        ///< robot.days, on a grid
  std::vector<LogExplanation> left_out;  ///< of each of them
};

struct ExplainedRobotOptions {
  IdentifyOptions identify{};
  double more_nats = 0.0;  ///< that a fault needs beside what healthy logs ask for
  int threads = 0;         ///< 0 = one a core; the result does not depend on it
};

/// healthy_robot() with what explains its logs. `logs` outlive the result. Throws Error(input) when they do
/// not suffice.
ExplainedRobot explained_robot(std::span<LogSource* const> logs, const Robot& robot,
                               const ExplainedRobotOptions& options, const Progress& progress = {});

/// Limits with `nats` more, or less where that is negative.
EvidenceLimits raised(EvidenceLimits limits, double nats);

}  // namespace faultline
