// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/identified_robot.hpp"

#include <memory>
#include <vector>

#include "lib/identify/identify.hpp"
#include "lib/log/memory_source.hpp"
#include "lib/robot/parameter.hpp"

namespace faultline {

Robot robot_as_known(TorqueTiming timing) {
  Robot robot = preset_robot("RRP");
  robot.name = "bench as known";
  robot.known["l1"] = {bench_robot().chain.length[0], 0.0};
  set_parameter(robot, "l1", robot.known["l1"].value);
  robot.log.torque_between_samples = timing;
  return robot;
}

Robot identified_robot(const Experiment& experiment, const LearningLogs& logs) {
  const RunOfMoves run{.duration_s = logs.duration_s, .sample_period_s = logs.sample_period_s};
  std::vector<std::unique_ptr<MemorySource>> sources;
  std::vector<LogSource*> healthy;
  for (int i = 0; i < logs.count; ++i) {
    const std::uint64_t own = seed_of(experiment.seed, SeedUse::learning_logs, i);
    Log log = run_of_moves(experiment.robot, experiment.controller, run, own);
    add_noise(log, experiment.ranges, logs.sigma, own);
    sources.push_back(std::make_unique<MemorySource>(std::move(log)));
    healthy.push_back(sources.back().get());
  }
  const bool is_held =
      experiment.controller == ControllerVariant::held || logs.sample_period_s < kSamplePeriod;
  const Robot known = robot_as_known(is_held ? TorqueTiming::held : TorqueTiming::unknown);
  return identify(healthy, known, {.max_rows = logs.max_rows, .max_iterations = 10, .threads = 1}).robot;
}

}  // namespace faultline
