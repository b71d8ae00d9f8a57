// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/evidence/motion_model.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"

namespace faultline {

/// Kalman filters side by side: the healthy robot and a free-swinging joint 1, 2, ... of `model`. The log
/// likelihood ratio of each fault against healthy is summed while positive (Page's CUSUM); at zero its filter
/// starts anew from the healthy state. Alarms of each threshold (nats), ascending; after an alarm the sum has
/// to return to zero before the next.
struct WatchOptions {
  std::vector<double> thresholds = {18.0};
  double name_s = 0.0;  ///< the fault is named by the largest sum this long after the alarm
};
std::vector<Alarms> watch_free_joints(const MotionModel& model, const Log& log, const WatchOptions& options);

}  // namespace faultline
