// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/identify/motion/motion_smoother.hpp"
#include "lib/identify/motion/raw_stretch.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// Relation of the measured velocity of a joint to the derivative of its position.
struct DerivativeAgreement {
  double factor = 1.0;       ///< measured over derived, by least squares
  double correlation = 1.0;  ///< of both

  /// Whether both are the same quantity in different units or with opposite signs.
  bool disagrees() const;
};

/// Returns words such as "dq1 is 57.3 times the derivative of q1: one of them is in degrees; dq1 was left
/// out". `joint` counts from 1.
std::string disagreement_text(const DerivativeAgreement& agreement, int joint);

/// Counts the rows in which each joint's torque is at its largest or smallest value.
class TorqueLimits {
 public:
  void add(const RawStretch& stretch);
  /// Returns an issue for each joint whose torque never changes or is at a limit in many rows: a command
  /// beyond the limit is not the torque that moved the robot.
  Issues issues() const;

 private:
  struct Extreme {
    double value = 0.0;
    long rows = 0;
    void see(double v);
  };
  std::vector<Extreme> high_, low_;
  long rows_ = 0;
};

/// Properties of a log that are needed before its motion can be smoothed.
struct LogSurvey {
  StretchSummary summary;
  RepeatedRows repeated_rows = RepeatedRows::none;
  double repeated_share = 0.0;                ///< share of the rows in motion that repeat the row before
  std::vector<char> dq_is_derived;            ///< by joint: its dq is computed from q (is_derived())
  std::vector<DerivativeAgreement> velocity;  ///< by joint
  std::vector<MotionNoise> noise;             ///< by joint, from the stretch in which it moves most
  TorqueLimits torque_limits;

  /// Whether the joint's dq, if recorded, is an independent measurement.
  bool measures_velocity(int joint) const { return !dq_is_derived[joint] && !velocity[joint].disagrees(); }
};

/// Reads a log from its start. Throws Error(input) if it lacks torque or its joints differ in number.
LogSurvey survey_log(LogSource& source, int joints);

/// Returns the findings of the survey that the user must see, as issues.
Issues survey_issues(const LogSurvey& survey);

}  // namespace faultline
