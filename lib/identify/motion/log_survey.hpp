// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/identify/motion/motion_smoother.hpp"
#include "lib/identify/motion/raw_stretch.hpp"
#include "lib/identify/motion/torque_limits.hpp"
#include "lib/identify/motion/velocity_agreement.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// What has to be known of a log before its motion can be smoothed.
struct LogSurvey {
  StretchSummary summary;
  RepeatedRows repeated_rows = RepeatedRows::none;
  double repeated_share = 0.0;         ///< of the rows in motion that repeat the one before
  std::vector<char> dq_is_difference;  ///< by joint: its dq is computed from q and tells nothing of its own
  std::vector<DerivativeAgreement> velocity;  ///< by joint
  std::vector<MotionNoise> noise;             ///< by joint, from where it moves most
  TorqueLimits torque_limits;

  /// Whether the joint's dq, where recorded, is a measurement of its own.
  bool measures_velocity(int joint) const { return !dq_is_difference[joint] && !velocity[joint].disagrees(); }
};

/// Reads a log from its start. Throws Error(input) when it lacks torque or has other joints.
LogSurvey survey_log(LogSource& source, int joints);

/// What the survey found that its user should know.
Issues survey_issues(const LogSurvey& survey);

}  // namespace faultline
