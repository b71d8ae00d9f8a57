// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_bench.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "lib/identify/identify.hpp"
#include "lib/log/memory_source.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

GeneratorBench generator_bench(const Experiment& experiment, int trajectories) {
  GeneratorBench bench{experiment, {}};
  for (int reading = 0; reading < 3; ++reading)
    bench.tests[reading] =
        healthy_trajectories(experiment, trajectories, kNoiseVariants[reading], SeedUse::generator_test);
  bench.tests[static_cast<int>(GeneratorTest::clean_runs)] =
      healthy_runs(experiment, trajectories, 0.0, SeedUse::generator_test);
  return bench;
}

WorstSamples worst_samples(const Eigen::MatrixXd& error, const HalfRanges& ranges, double share_of_samples) {
  Eigen::VectorXd squares =
      (ranges.state().cwiseInverse().asDiagonal() * error).array().square().colwise().mean();
  if (!squares.allFinite() || squares.size() == 0) return {};
  std::sort(squares.begin(), squares.end(), std::greater<>());
  const auto worst = static_cast<Eigen::Index>(share_of_samples * static_cast<double>(squares.size()));
  return {squares.head(worst).sum() / squares.sum(), squares.tail(squares.size() - worst).mean()};
}

GeneratorErrors errors_of(const ResidualGenerator& generator, const GeneratorBench& bench) {
  const HalfRanges& ranges = bench.experiment.ranges;
  GeneratorErrors errors{Eigen::MatrixXd(2 * generator.joints(), kGeneratorTests), {}};
  for (int test = 0; test < kGeneratorTests; ++test) {
    const Transitions transitions = transitions_of(bench.tests[test], generator.shape.torque_phi);
    const Eigen::MatrixXd error =
        measured_change(generator, transitions) - predicted_change(generator, transitions);
    errors.mse.col(test) = normalised_mse_by_output(error, ranges);
    if (test == static_cast<int>(GeneratorTest::clean_runs))
      errors.worst = worst_samples(error, ranges, share_with_a_start());
  }
  return errors;
}

GeneratorErrors persistence_errors(const GeneratorBench& bench) {
  GeneratorErrors errors{Eigen::MatrixXd(2 * bench.experiment.robot.joints(), kGeneratorTests), {}};
  for (int test = 0; test < kGeneratorTests; ++test) {
    const Transitions transitions = transitions_of(bench.tests[test]);
    Eigen::MatrixXd change(errors.mse.rows(), transitions.count());
    change << transitions.next_q - transitions.q, transitions.next_dq - transitions.dq;
    errors.mse.col(test) = normalised_mse_by_output(change, bench.experiment.ranges);
  }
  return errors;
}

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
