// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/core/issue.hpp"
#include "lib/evidence/log_noise.hpp"
#include "lib/evidence/motion_model.hpp"
#include "lib/log/log_source.hpp"

namespace faultline {

/// What a log's first rows say of its day before it is judged: how it measures, how it is stamped, and how
/// rough the torque is that the model misses.
struct LogDay {
  MotionModel model;  ///< as it suits this log
  LogNoise noise;
  std::vector<double> torque_delay_s;  ///< by joint, for DelayedTorqueSource; empty for none
  /// By joint: the torque that the filter lets the model miss, times that of the learned logs; empty for as
  /// much as in those.
  std::vector<double> roughness;
  Issues notes;  ///< stamps_wobble, torque_timing, noisy_readings, torque_rough
};

/// How a log measures against the model's logs, from its first rows. Rewinds the log before and after.
LogNoise survey_noise(LogSource& log, const MotionModel& model);

/// Where the model does not explain the first motion, what is tried is: rows in step whose stamps wobble,
/// torque logged a row late or early, and a rougher coloured torque. It is taken only where the very first
/// stretches of motion ask for it, so that a fault within these rows is not excused. Rewinds the log before
/// and after.
LogDay survey_log(LogSource& log, const MotionModel& model);

}  // namespace faultline
