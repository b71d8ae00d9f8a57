// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/one_step/one_step_model.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"

namespace faultline {

/// A robot for Kalman filters over whole samples: its one-step predictions, and the torque that they miss
/// beside what the model itself allows for.
struct FilteredRobot {
  OneStepModel steps;
  double missed_share =
      0.0;  ///< of each joint's usual torque, constant over an interval (standard deviation)
};

/// `robot` with the missed share under which these healthy logs are likeliest.
FilteredRobot with_missed_share(const OneStepModel& robot, const std::vector<Log>& healthy);

/// Extended Kalman filters side by side: the healthy robot and a free-swinging joint 1, 2, ... . The log
/// likelihood ratio of each fault against healthy is summed while it is positive (Page's CUSUM); at zero its
/// filter starts anew from the healthy state. Returns the alarms of each threshold; after an alarm the sum
/// has to return to zero before the next. `thresholds` ascend, in nats; the largest sum `name_s` after the
/// alarm names the fault.
std::vector<Alarms> free_joint_alarms(const FilteredRobot& robot, const Log& log,
                                      const std::vector<double>& thresholds, double name_s);

}  // namespace faultline
