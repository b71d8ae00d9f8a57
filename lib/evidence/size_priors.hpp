// SPDX-License-Identifier: MIT
#pragma once

#include "lib/evidence/healthy_statistics.hpp"
#include "lib/evidence/motion_model.hpp"

namespace faultline {

/// How large faults are thought to be before anything is seen of them, against what the healthy logs show.
/// Two to three of these standard deviations hold what the twin draws; wider priors cost likelihood.
struct SizePriorOptions {
  double bias_share = 0.02;   ///< of the joint's range: some degrees
  double drift_share = 0.02;  ///< of the joint's range, in a second
  double friction_share =
      0.05;  ///< of the joint's usual torque: added friction at least, where there was none
  double external_share = 0.5;  ///< of the joint's largest torque: pushes, and what nobody knows
  double payload_share = 0.5;   ///< of what the robot carries: size_scale.cpp takes it that this is a half
};

/// `model` has its chain, ranges, scales of torque and inertia.
SizePriors size_priors(const MotionModel& model, const HealthyStatistics& healthy,
                       const SizePriorOptions& options);

}  // namespace faultline
