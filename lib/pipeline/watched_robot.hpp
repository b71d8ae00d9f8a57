// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/evidence/learn/learn_motion_model.hpp"
#include "lib/pipeline/healthy_robot.hpp"

namespace faultline {

/// A healthy robot whose model has its bank of faults and their thresholds.
struct WatchedRobot {
  HealthyRobot robot;
  std::vector<HealthyExtremes> extremes;  ///< of robot.logs
};

struct WatchedRobotOptions {
  IdentifyOptions identify{};
  EvidenceOptions start{};  ///< what thresholds are raised from
  int threads = 0;          ///< 0 = one a core; the result does not depend on it
};

/// healthy_robot() with bank and thresholds. `logs` outlive the result. Throws Error(input) when they do not
/// suffice.
WatchedRobot watched_robot(std::span<LogSource* const> logs, const Robot& robot,
                           const WatchedRobotOptions& options, const Progress& progress = {});

}  // namespace faultline
