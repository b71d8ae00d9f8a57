// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/monitored_runs.hpp"

#include <algorithm>

#include "lib/core/random.hpp"

namespace faultline {
namespace {

constexpr std::uint64_t kFaultFreeRuns = 1'000'000;  // their indices begin here
constexpr std::uint64_t kRunsNoise = 2'000'000;

ExperimentRun faulty_run(const Experiment& experiment, const RunSet& set, int index, std::uint64_t seed) {
  Random random = Random::stream(seed, 3);
  ExperimentRun run;
  run.fault = {FaultKind::free_swinging, 1 + index % experiment.robot.joints()};
  run.onset_s = random.uniform(set.earliest_onset_s, set.latest_onset_s);
  run.log =
      run_of_moves(experiment.robot, experiment.controller,
                   {.duration_s = run.onset_s + set.after_onset_s, .fault = {run.fault, run.onset_s}}, seed);
  return run;
}

}  // namespace

std::vector<ExperimentRun> monitored_runs(const Experiment& experiment, const RunSet& set, SeedUse use) {
  std::vector<ExperimentRun> runs;
  for (int i = 0; i < set.faulty; ++i)
    runs.push_back(faulty_run(experiment, set, i, seed_of(experiment.seed, use, i)));
  double left_s = set.fault_free_h * 3600.0;
  for (std::uint64_t i = kFaultFreeRuns; left_s > kSamplePeriod; ++i) {
    const double duration_s = std::min(left_s, set.hour_s);
    ExperimentRun run;
    run.log =
        run_of_moves(experiment.robot, experiment.controller, {duration_s}, seed_of(experiment.seed, use, i));
    runs.push_back(std::move(run));
    left_s -= duration_s;
  }
  return runs;
}

std::vector<ExperimentRun> with_noise(std::vector<ExperimentRun> runs, const Experiment& experiment,
                                      double sigma, SeedUse use) {
  for (std::size_t i = 0; i < runs.size(); ++i)
    add_noise(runs[i].log, experiment.ranges, sigma, seed_of(experiment.seed, use, kRunsNoise + i));
  return runs;
}

}  // namespace faultline
