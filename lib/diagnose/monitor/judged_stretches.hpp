// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "lib/diagnose/diagnosis.hpp"
#include "lib/log/log.hpp"
#include "lib/log/log_run.hpp"

namespace faultline {

/// Finds the stretches of a log in which a joint could not be judged: rows without its position or torque (if
/// the log has torque), and missing rows. The time between two runs is no such stretch.
class JudgedStretches {
 public:
  /// Takes the next rows; `runs` are those known so far.
  void take(const Log& segment, const std::vector<LogRun>& runs);
  /// Returns those longer than a moment at this sample period, by start; complete after the last row.
  std::vector<UnjudgedStretch> longer_than_a_moment(double sample_period_s) const;

 private:
  struct Joint {
    double judged_s = 0.0;  ///< last row at which it was judged, or the run's first
    bool lacks_position = false, lacks_torque = false;
  };

  void begin_run(double time_s);
  void end_run(std::vector<UnjudgedStretch>& stretches) const;
  static void note(const UnjudgedStretch& stretch, std::vector<UnjudgedStretch>& stretches);

  std::vector<Joint> joints_;
  std::vector<UnjudgedStretch> stretches_;
  double last_s_ = -std::numeric_limits<double>::infinity(), last_step_s_ = 0.0;
  std::size_t run_ = 0;
};

}  // namespace faultline
