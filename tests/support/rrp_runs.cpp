// SPDX-License-Identifier: MIT
#include "tests/support/rrp_runs.hpp"

#include "lib/evidence/usual_motion.hpp"

namespace faultline {

Robot known_rrp() {
  Robot robot = preset_robot("RRP");
  set_masses_and_lengths(robot, {8.0, 5.0, 2.5}, {0.35, 0.3, 0.0});
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

SimulationSpec rrp_run_with(FaultKind kind, int joint, double onset_s, double size, double length_s) {
  SimulationSpec spec = rrp_run(onset_s + 3.0);
  spec.faults = {{kind, joint, onset_s, onset_s + length_s, size, 0.0}};
  spec.overspeed = {12.0, 12.0, 4.0};
  return spec;
}

std::vector<std::unique_ptr<MemorySource>> healthy_rrp_logs() {
  std::vector<std::unique_ptr<MemorySource>> logs;
  for (const std::uint64_t seed : {11, 12})
    logs.push_back(std::make_unique<MemorySource>(simulate(known_rrp(), rrp_run(12.0), seed).log));
  return logs;
}

const MotionModel& rrp_motion_model() {
  static const MotionModel model = [] {
    const auto owners = healthy_rrp_logs();
    std::vector<LogSource*> logs;
    for (const auto& log : owners) logs.push_back(log.get());
    IdentifiedMotion identified;
    identified.chain = known_rrp().chain;
    identified.torque_is_held = true;
    identified.q_std = {1e-4, 1e-4, 2e-5};
    identified.dq_std = {5e-3, 5e-3, 1e-3};
    return usual_motion(logs, identified);
  }();
  return model;
}

}  // namespace faultline
