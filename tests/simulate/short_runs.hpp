// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "lib/robot/dynamics.hpp"
#include "lib/simulate/simulate.hpp"

/// Runs of a few seconds of an arm of industrial size.
namespace faultline {

inline Robot industrial() {
  Robot robot = preset_robot("RRP");
  robot = with_masses_and_lengths(robot, {8.0, 5.0, 2.5}, {0.35, 0.3, 0.0});
  robot.chain.friction = {{2.0, 3.0, 0.0, 0.02}, {1.0, 2.0, 0.0, 0.02}, {20.0, 8.0, 0.0, 0.01}};
  return robot;
}

inline SimulationSpec short_run(double duration_s = 3.0) {
  SimulationSpec spec;
  spec.duration_s = duration_s;
  spec.motion.dwell_max_s = 0.3;
  spec.record_reference = true;
  return spec;
}

inline SimulationSpec with_fault(FaultKind kind, Joint joint, double onset_s, double size = 0.0,
                                 double duration_s = 3.0) {
  SimulationSpec spec = short_run(duration_s);
  spec.faults = {{kind, joint, onset_s, std::numeric_limits<double>::infinity(), size, 0.0}};
  return spec;
}

inline JointVector row_of(const JointSignals& signals, int row) {
  JointVector values(static_cast<int>(signals.size()));
  for (int i = 0; i < values.size(); ++i) values[i] = signals[i][row];
  return values;
}

/// Torque that the motion between two rows asks for on the healthy robot, by central differences of dq.
inline JointVector torque_needed(const Chain& chain, const Log& log, int row) {
  const double dt = log.time[row + 1] - log.time[row - 1];
  const JointVector ddq = (row_of(log.dq, row + 1) - row_of(log.dq, row - 1)) / dt;
  return inverse_dynamics(chain, row_of(log.q, row), row_of(log.dq, row), ddq);
}

}  // namespace faultline
