// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/core/joint.hpp"
#include "lib/identify/motion/motion_smoother.hpp"
#include "lib/identify/motion/raw_stretch.hpp"
#include "lib/log/log_source.hpp"
#include "lib/log/quality.hpp"

namespace faultline {

/// Returns words such as "dq1 is 57.3 times the derivative of q1: the velocity seems to be in deg/s, the
/// position in rad; dq1 was left out".
std::string other_unit_text(const VelocityAgreement& agreement, Joint joint);

/// Properties of a log that are needed before its motion can be smoothed.
struct LogSurvey {
  StretchSummary summary;
  RepeatedRows repeated_rows = RepeatedRows::none;
  double repeated_share = 0.0;              ///< share of the rows in motion that repeat the row before
  std::vector<char> dq_is_derived;          ///< by joint: its dq is computed from q (is_derived())
  std::vector<VelocityAgreement> velocity;  ///< by joint, from the stretch in which it moves most
  std::vector<MotionNoise> noise;           ///< by joint, from the same stretch
  std::vector<ChannelSummary> torque;       ///< by joint

  /// Whether the joint's dq, if recorded, is an independent measurement.
  bool measures_velocity(int j) const { return !dq_is_derived[j] && !velocity[j].is_other_unit(); }
};

/// Reads a log from its start. Throws Error(input) if it lacks torque or its joints differ in number.
LogSurvey survey_log(LogSource& source, int joints);

/// Returns the findings of the survey that the user must see, as issues. `known_limit` holds the limit of
/// each drive to which the torques are cut (Robot::torque_limit; 0 or no entry: not known).
Issues survey_issues(const LogSurvey& survey, const std::vector<double>& known_limit = {});

}  // namespace faultline
