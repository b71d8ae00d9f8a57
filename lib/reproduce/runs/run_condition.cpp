// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/run_condition.hpp"

#include <algorithm>

#include "lib/reproduce/protocol/motion_generator.hpp"
#include "lib/reproduce/runs/filter_detectors.hpp"
#include "lib/reproduce/runs/network_detectors.hpp"
#include "lib/reproduce/runs/product_detector.hpp"

namespace faultline {
namespace {

constexpr int kNoisyIterations =
    30;  // of generators trained with noise, whose error is soon the noise itself

bool contains(const std::vector<double>& values, double value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// What all noises of one controller and seed share.
struct RunBench {
  Experiment experiment;
  RunPlan plan;
  ConditionRuns clean;
  ResidualGenerator paper_generator;
};

RunBench run_bench(ControllerReading controller, const RunPlan& plan, std::uint64_t seed) {
  RunBench bench{experiment_on(bench_robot(), controller, seed), plan, {}, {}};
  bench.clean = {monitored_runs(bench.experiment, plan.training, SeedUse::run_training),
                 monitored_runs(bench.experiment, plan.tuning, SeedUse::run_tuning),
                 monitored_runs(bench.experiment, plan.test, SeedUse::run_test)};
  GeneratorRecipe recipe;
  recipe.trajectories = plan.generator_trajectories;
  recipe.fit.max_iterations = plan.generator_iterations;
  bench.paper_generator = train_generator(bench.experiment, recipe).generator;
  return bench;
}

ConditionRuns measured(const RunBench& bench, double sigma) {
  return {with_noise(bench.clean.training, bench.experiment, sigma, SeedUse::run_training),
          with_noise(bench.clean.tuning, bench.experiment, sigma, SeedUse::run_tuning),
          with_noise(bench.clean.test, bench.experiment, sigma, SeedUse::run_test)};
}

/// Held: physics of the identified robot. Else what the torque did between two samples is unknown to physics,
/// and a 12-49-6 network trained with the noise of use does better.
ResidualGenerator best_generator(const RunBench& bench, const Chain<double>& identified, double sigma) {
  GeneratorRecipe recipe;
  recipe.sigma = sigma;
  recipe.trajectories = bench.plan.generator_trajectories;
  if (bench.experiment.controller == ControllerReading::held) {
    recipe.fit.kind = ResidualKind::physics;
    recipe.assumed = identified;
  } else {
    recipe.next_torque = true;
    recipe.fit.max_iterations = std::min(kNoisyIterations, bench.plan.generator_iterations);
  }
  return train_generator(bench.experiment, recipe).generator;
}

void append(std::vector<DetectorResult>& all, std::vector<DetectorResult> more) {
  for (DetectorResult& result : more) all.push_back(std::move(result));
}

ConditionResult run_condition(const RunBench& bench, double sigma) {
  const Experiment& e = bench.experiment;
  const RunPlan& plan = bench.plan;
  const bool held = e.controller == ControllerReading::held;
  const ConditionRuns runs = measured(bench, sigma);
  const HealthyLogs healthy = healthy_logs(e, plan.healthy_log_s, sigma);
  ConditionResult result{sigma, {}, {}};
  watch_with_networks(train_paper_detector(bench.paper_generator, e), runs, "paper's recipe", false, result);

  const bool learns = contains(plan.learned_sigmas, sigma);
  Learned learned;
  if (learns) learned = learn_product(healthy, plan.quick, e.seed);
  const Chain<double> identified = learns ? learned.model.robot.chain
                                   : held ? identify_robot(healthy).robot.chain
                                          : e.robot.chain;
  watch_with_networks(train_best_detector(best_generator(bench, identified, sigma), runs.training,
                                          plan.patterns_per_class, e.seed),
                      runs, "best recipe", true, result);

  const auto tuning = some_of(runs.tuning, plan.filter_tuning_faulty, plan.filter_tuning_h);
  if (learns) {
    const auto test = some_of(runs.test, plan.filter_faulty, plan.filter_fault_free_h);
    result.detectors.push_back(watch_with_filters(
        detector_name::kFilters,
        with_missed_share(std::get<OneStepModel>(learned.model.explain.robot), healthy.logs), tuning, test));
    append(result.detectors, watch_with_product(learned, test));
  }
  if (!contains(plan.filtered_sigmas, sigma)) return result;
  const FilteredRobot known = with_missed_share(known_steps(e.robot, healthy), healthy.logs);
  const auto test = some_of(runs.test, plan.reference_faulty, plan.reference_h);
  result.detectors.push_back(watch_with_filters(detector_name::kReference, known, tuning, test));
  return result;
}

}  // namespace

RunPlan run_plan(ControllerReading controller, bool quick) {
  RunPlan plan;
  plan.quick = quick;
  const bool held = controller == ControllerReading::held;
  if (held) plan.learned_sigmas = {0.01, 0.1};
  if (!held) {
    plan.training.fault_free_h = 0.5;
    plan.tuning = {.faulty = 100, .fault_free_h = 3.0};
    plan.test = {.faulty = 60, .fault_free_h = 2.0};
  }
  if (!quick) return plan;
  plan.training = {.faulty = 30, .fault_free_h = 0.05, .after_onset_s = 2.0};
  plan.tuning = plan.test = {.faulty = 18, .fault_free_h = 0.1, .hour_s = 360.0};
  plan.sigmas = {0.01};
  if (held) plan.sigmas = {0.01, 0.1};
  plan.filter_faulty = 12;
  plan.filter_fault_free_h = plan.filter_tuning_h = plan.reference_h = 0.1;
  plan.reference_faulty = 6;
  plan.filter_tuning_faulty = 6;
  plan.healthy_log_s = 20.0;
  plan.generator_trajectories = 30;
  plan.generator_iterations = 10;
  plan.patterns_per_class = 200;
  plan.learned_sigmas.clear();
  if (held) plan.learned_sigmas = {0.01};
  plan.filtered_sigmas.clear();
  if (held) plan.filtered_sigmas = {0.01};
  return plan;
}

std::vector<ConditionResult> run_conditions(ControllerReading controller, const RunPlan& plan,
                                            std::uint64_t seed) {
  const RunBench bench = run_bench(controller, plan, seed);
  std::vector<ConditionResult> results;
  for (const double sigma : plan.sigmas) results.push_back(run_condition(bench, sigma));
  return results;
}

}  // namespace faultline
