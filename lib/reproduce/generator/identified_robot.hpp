// SPDX-License-Identifier: MIT
#pragma once

#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

/// Healthy runs of moves that a robot is identified from.
struct LearningLogs {
  int count = 3;
  double duration_s = 60.0;
  double sample_period_s = kSamplePeriod;
  double sigma = 0.0;  ///< noise in half ranges
  int max_rows = 600;  ///< that shooting uses; identification is dearer than training a network here
};

/// What a user knows of the bench robot: its axes, the length of its first link, and whether the torque is
/// held between samples.
Robot robot_as_known(TorqueTiming timing);

/// That robot identified from healthy logs of the true one alone, friction and torque timing with it.
Robot identified_robot(const Experiment& experiment, const LearningLogs& logs);

}  // namespace faultline
