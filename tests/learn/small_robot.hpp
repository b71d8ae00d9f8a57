// SPDX-License-Identifier: MIT
#pragma once

#include "lib/learn/learn.hpp"
#include "lib/log/log_source.hpp"
#include "lib/simulate/simulate.hpp"

namespace faultline {

/// A vertical slide of 2 kg with friction, one prismatic axis, so that learning it takes seconds.
inline Robot small_robot() {
  Robot robot = preset_robot("P");
  robot = with_masses_and_lengths(robot, {2.0}, {0.0});
  robot.chain.friction = {{4.0, 1.5, 0.0, 0.01}};
  robot.name = "slide";
  robot.log.torque_between_samples = TorqueTiming::held;
  return robot;
}

/// What its user knows of it.
inline Robot unknown_small_robot() {
  Robot robot = preset_robot("P");
  robot.name = "slide";
  robot.log.torque_between_samples = TorqueTiming::held;
  return robot;
}

inline SimulationSpec small_run(double duration_s) {
  SimulationSpec spec;
  spec.duration_s = duration_s;
  spec.sample_period_s = spec.control_period_s = 0.01;
  spec.motion.dwell_max_s = 0.3;
  spec.noise.q = {2e-5};
  spec.noise.dq = {1e-3};
  return spec;
}

inline LearnOptions quick_learning() {
  LearnOptions options;
  options.runs_per_label = 4;
  options.validation_per_label = 1;
  options.healthy_runs = 4;
  return options;
}

/// Learns the robot from two simulated runs.
inline Learned learn_small(const LearnOptions& options = quick_learning(), int segment_rows = 4096) {
  MemorySource first(simulate(small_robot(), small_run(20.0), 21).log, "a.csv", segment_rows),
      second(simulate(small_robot(), small_run(20.0), 22).log, "b.csv", segment_rows);
  std::vector<LogSource*> logs = {&first, &second};
  return learn(logs, {}, unknown_small_robot(), options);
}

}  // namespace faultline
