// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/evidence/motion_model.hpp"
#include "lib/evidence/size_priors.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// What identification says of the motion of a robot.
struct IdentifiedMotion {
  Chain<double> chain;
  double torque_phi = 0.0;
  bool torque_is_held = false;  ///< known, not estimated: nothing unseen happens between two samples
  std::vector<double> q_std;    ///< measurement noise, one a joint
  std::vector<double> dq_std;
};

/// The robot with ranges, scales, repeated codes and size priors of its healthy logs; the process noise stays
/// where matching starts. Throws Error(input) when the logs hold too few rows.
MotionModel usual_motion(std::span<LogSource* const> logs, const IdentifiedMotion& identified,
                         const SizePriorOptions& priors = {});

}  // namespace faultline
