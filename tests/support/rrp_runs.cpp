// SPDX-License-Identifier: MIT
#include "tests/support/rrp_runs.hpp"

#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

Robot known_rrp() {
  Robot robot = preset_robot("RRP");
  robot = with_masses_and_lengths(robot, {8.0, 5.0, 2.5}, {0.35, 0.3, 0.0});
  robot.chain.friction = {{2.0, 3.0, 0.0, 0.02}, {1.0, 2.0, 0.0, 0.02}, {20.0, 8.0, 0.0, 0.01}};
  return robot;
}

SimulationSpec rrp_run(double duration_s) {
  SimulationSpec spec;
  spec.duration_s = duration_s;
  spec.sample_period_s = spec.control_period_s = 0.01;
  spec.motion.dwell_max_s = 0.3;
  spec.noise.q = {1e-4, 1e-4, 2e-5};
  spec.noise.dq = {5e-3, 5e-3, 1e-3};
  return spec;
}

SimulationSpec rrp_run_with(FaultKind kind, Joint joint, double onset_s, double size, double length_s) {
  SimulationSpec spec = rrp_run(onset_s + 3.0);
  spec.faults = {{kind, joint, onset_s, onset_s + length_s, size, 0.0}};
  spec.overspeed = {12.0, 12.0, 4.0};
  return spec;
}

const UsualMotion& rrp_usual_motion() {
  static const UsualMotion usual = [] {
    std::vector<MemorySource> logs;
    for (const std::uint64_t seed : {11, 12})
      logs.emplace_back(simulate(known_rrp(), rrp_run(12.0), seed).log);
    return usual_motion(std::vector<LogSource*>{&logs[0], &logs[1]}, known_rrp().chain);
  }();
  return usual;
}

}  // namespace faultline
