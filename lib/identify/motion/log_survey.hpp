// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/identify/motion/motion_smoother.hpp"
#include "lib/identify/motion/raw_stretch.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// How the measured velocity of a joint goes with the derivative of its position.
struct DerivativeAgreement {
  double factor = 1.0;       ///< measured over derived, by least squares
  double correlation = 1.0;  ///< of both

  /// They are the same quantity in different units or with different signs.
  bool disagrees() const;
};

/// Counts how often each joint's torque stands at its largest and smallest value.
class TorqueLimits {
 public:
  void add(const RawStretch& stretch);
  /// Joints whose torque never changes, and those that stand at a limit for a good part of the log: what was
  /// asked for beyond it is not what moved the robot.
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
