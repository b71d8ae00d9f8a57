// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "lib/log/log.hpp"

namespace faultline {

/// The values of all joints at one time: positions, then velocities, then torques, as far as the log has
/// them.
struct MeasuredRow {
  double t = 0.0;
  std::vector<double> values;
  int joints = 0;
  bool has_velocity = false;
  bool has_torque = false;

  double q(int j) const { return values[j]; }
  double dq(int j) const { return has_velocity ? values[joints + j] : std::nan(""); }

  /// Copies row `row` of a segment, reusing the storage.
  void take(const Log& log, int row) {
    t = log.time[row];
    joints = log.joints();
    has_velocity = !log.dq.empty();
    has_torque = !log.tau.empty();
    values.clear();
    for (const JointSignals* signals : {&log.q, &log.dq, &log.tau})
      for (const std::vector<double>& joint : *signals) values.push_back(joint[row]);
  }
};

}  // namespace faultline
