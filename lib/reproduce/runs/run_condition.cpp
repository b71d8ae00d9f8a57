// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/run_condition.hpp"

#include <algorithm>
#include <span>

#include "lib/learn/learn.hpp"
#include "lib/reproduce/protocol/motion_generator.hpp"
#include "lib/reproduce/runs/criterion_sweep.hpp"
#include "lib/reproduce/runs/detectors.hpp"
#include "lib/reproduce/runs/dual_decision.hpp"
#include "lib/reproduce/runs/free_joint_filter.hpp"

namespace faultline {
namespace {

constexpr int kNoisyIterations =
    30;  // of generators trained with noise, whose error is soon the noise itself

constexpr int kMostG = 30;
constexpr double kSampleCap = 10.0;    // nats; the least output that counts limits it to about as much
constexpr double kLeastLogOdds = 1.5;  // nats
constexpr double kLargestThreshold = 70.0;
constexpr double kThresholdStep = 1.15;
constexpr int kCasesOfClass = 100;
constexpr int kFalseCases = 300;

constexpr const char* kNetworks[] = {"MLP", "RBFN", "average of both"};

// Nats. At 73 ms a sample of a clear fault adds several, so that a coarse grid costs little.
const std::vector<double> kThresholds = {7, 10, 14, 20, 28, 40, 56, 80, 110, 160, 220};
constexpr double kName_s = 0.6;

struct ConditionRuns {
  std::vector<ExperimentRun> training, tuning, test;
};

std::vector<double> thresholds() {
  std::vector<double> values;
  for (double value = kLeastLogOdds; value < kLargestThreshold; value *= kThresholdStep)
    values.push_back(value);
  return values;
}

/// Scores of every way to decide, a score a setting.
struct Sweep {
  std::vector<AlarmScore> consecutive[3], log_odds[3];  // of each network and their average
  std::vector<AlarmScore> cases_at_samples, cases_of_episodes;
  Agreement agreement;
};

void add(std::vector<AlarmScore>& scores, const ExperimentRun& run, const std::vector<Alarms>& alarms) {
  scores.resize(alarms.size());
  for (std::size_t i = 0; i < alarms.size(); ++i) scores[i].add(run, alarms[i]);
}

void add(Agreement& agreement, const ExperimentRun& run, const SampleOutputs& outputs) {
  for (Eigen::Index i = 0; i < outputs.time.size() && run.faulty(); ++i) {
    if (outputs.time[i] <= run.onset_s) continue;
    if (!outputs.mlp.col(i).allFinite() || !outputs.rbfn.col(i).allFinite()) continue;
    Eigen::Index by_mlp = 0, by_rbfn = 0;
    outputs.mlp.col(i).maxCoeff(&by_mlp);
    outputs.rbfn.col(i).maxCoeff(&by_rbfn);
    ++agreement.samples;
    agreement.same += by_mlp == by_rbfn;
  }
}

struct Cases {
  CaseBase samples, suspicions;
};

Sweep sweep(const SampleDetector& detector, const Cases& cases, std::span<const ExperimentRun> runs,
            bool sum_log_odds) {
  const SampleClassifier& classifier = detector.classifier;
  const OutputMeaning meaning{classifier.classes, classifier.prior};
  const std::vector<double> tried = thresholds();
  Sweep out;
  for (const ExperimentRun& run : runs) {
    const SampleOutputs outputs = outputs_of(detector, run.log);
    add(out.agreement, run, outputs);
    const Eigen::MatrixXd networks[] = {outputs.mlp, outputs.rbfn, outputs.average()};
    for (int n = 0; n < 3; ++n) {
      add(out.consecutive[n], run, sweep_consecutive(meaning, outputs.time, networks[n], kMostG));
      if (sum_log_odds)
        add(out.log_odds[n], run, sweep_log_odds(meaning, outputs.time, networks[n], tried, kSampleCap));
    }
    add(out.cases_at_samples, run,
        sweep_consecutive(meaning, outputs.time, decide_samples(outputs, meaning.classes, cases.samples),
                          kMostG));
    if (sum_log_odds)
      add(out.cases_of_episodes, run,
          decide_suspects(suspect_samples(classifier, outputs, kSampleCap, kLeastLogOdds), meaning.classes,
                          cases.suspicions, tried));
  }
  return out;
}

/// The setting that the tuning runs choose, measured on the test runs.
DetectorResult chosen(const std::string& detector, const char* decision,
                      const std::vector<AlarmScore>& tuning, const std::vector<AlarmScore>& test,
                      bool counts) {
  const int setting = choose_setting(tuning);
  return {detector, decision, counts ? setting + 1.0 : thresholds()[setting], test[setting]};
}

/// Networks over the residuals of single samples: MLP, RBFN, their average and the case-based decision, each
/// under the paper's criterion and, with `sum_log_odds` (networks that put out probabilities), under summed
/// log odds. `recipe` begins the detectors' names; of the recipe with `sum_log_odds` it is also counted how
/// often both networks agree.
void detect_with_networks(const SampleDetector& detector, const ConditionRuns& runs,
                          const std::string& recipe, bool sum_log_odds, ConditionResult& result) {
  Cases cases{cases_of_samples(detector, runs.training, kCasesOfClass), {}};
  if (sum_log_odds)
    cases.suspicions = cases_of_suspects(detector, runs.tuning, kSampleCap, kLeastLogOdds, kFalseCases);
  const Sweep tuning = sweep(detector, cases, runs.tuning, sum_log_odds);
  const Sweep test = sweep(detector, cases, runs.test, sum_log_odds);
  if (sum_log_odds) result.best_networks = test.agreement;
  for (int n = 0; n < 3; ++n) {
    const std::string name = recipe + ", " + kNetworks[n];
    result.trade_offs.push_back({name, test.consecutive[n]});
    result.detectors.push_back(
        chosen(name, decision_name::kConsecutive, tuning.consecutive[n], test.consecutive[n], true));
    if (sum_log_odds)
      result.detectors.push_back(
          chosen(name, decision_name::kLogOdds, tuning.log_odds[n], test.log_odds[n], false));
  }
  const std::string name = recipe + ", both and cases";
  result.trade_offs.push_back({name, test.cases_at_samples});
  result.detectors.push_back(
      chosen(name, decision_name::kConsecutive, tuning.cases_at_samples, test.cases_at_samples, true));
  if (sum_log_odds)
    result.detectors.push_back(
        chosen(name, decision_name::kLogOdds, tuning.cases_of_episodes, test.cases_of_episodes, false));
}

std::vector<AlarmScore> scores(const FilteredRobot& robot, std::span<const ExperimentRun> runs,
                               const std::vector<double>& thresholds) {
  std::vector<AlarmScore> scores;
  for (const ExperimentRun& run : runs)
    add(scores, run, free_joint_alarms(robot, run.log, thresholds, kName_s));
  return scores;
}

/// Filters for the healthy robot and each free joint, the threshold of their summed log likelihood ratio
/// chosen on `tuning`; the fault is named 0.6 s after the alarm, as `diagnose` does.
DetectorResult detect_with_filters(const std::string& detector, const FilteredRobot& robot,
                                   std::span<const ExperimentRun> tuning,
                                   std::span<const ExperimentRun> test) {
  const double threshold = kThresholds[choose_setting(scores(robot, tuning, kThresholds))];
  return {detector, decision_name::kLogOdds, threshold, scores(robot, test, {threshold}).front()};
}

/// What `diagnose` says with this model, named by either network alone and by both with cases.
std::vector<DetectorResult> detect_with_product(const Learned& learned, std::span<const ExperimentRun> test) {
  const double threshold = learned.model.explain.limits.of(FaultKind::free_swinging);
  std::vector<DetectorResult> results;
  for (const char* name :
       {detector_name::kProductMlp, detector_name::kProductRbfn, detector_name::kProductCases})
    results.push_back({name, decision_name::kRegression, threshold, {}});
  for (const ExperimentRun& run : test) {
    const ProductAlarms alarms = product_alarms(learned, run.log);
    results[0].score.add(run, alarms.mlp);
    results[1].score.add(run, alarms.rbfn);
    results[2].score.add(run, alarms.cases);
  }
  return results;
}

/// The first `faulty` faulty runs and fault-free ones of about `fault_free_h` hours.
std::vector<ExperimentRun> some_of(std::span<const ExperimentRun> runs, int faulty, double fault_free_h) {
  std::vector<ExperimentRun> some;
  double hours = 0.0;
  for (const ExperimentRun& run : runs) {
    if (run.faulty() ? faulty-- <= 0 : hours > fault_free_h - 1e-3) continue;
    if (!run.faulty()) hours += run.log.time.back() / 3600.0;
    some.push_back(run);
  }
  return some;
}

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

RunBench run_bench(ControllerVariant controller, const RunPlan& plan, std::uint64_t seed) {
  RunBench bench{experiment_on(bench_robot(), controller, seed), plan, {}, {}};
  bench.clean = {monitored_runs(bench.experiment, plan.training, SeedUse::run_training),
                 monitored_runs(bench.experiment, plan.tuning, SeedUse::run_tuning),
                 monitored_runs(bench.experiment, plan.test, SeedUse::run_test)};
  GeneratorRecipe recipe;
  recipe.trajectories = plan.generator_trajectories;
  recipe.fit.max_iterations = plan.generator_iterations;
  bench.paper_generator = train_generator(bench.experiment, recipe);
  return bench;
}

ConditionRuns measured(const RunBench& bench, double sigma) {
  return {with_noise(bench.clean.training, bench.experiment, sigma, SeedUse::run_training),
          with_noise(bench.clean.tuning, bench.experiment, sigma, SeedUse::run_tuning),
          with_noise(bench.clean.test, bench.experiment, sigma, SeedUse::run_test)};
}

/// Held: physics of the identified robot. Else what the torque did between two samples is unknown to physics,
/// and a 12-49-6 network trained with the noise of use does better.
ResidualGenerator best_generator(const RunBench& bench, const Chain& identified, double sigma) {
  GeneratorRecipe recipe;
  recipe.sigma = sigma;
  recipe.trajectories = bench.plan.generator_trajectories;
  if (bench.experiment.controller == ControllerVariant::held) {
    recipe.fit.kind = ResidualKind::physics;
    recipe.assumed = identified;
  } else {
    recipe.next_torque = true;
    recipe.fit.max_iterations = std::min(kNoisyIterations, bench.plan.generator_iterations);
  }
  return train_generator(bench.experiment, recipe);
}

ConditionResult run_condition(const RunBench& bench, double sigma) {
  const Experiment& e = bench.experiment;
  const RunPlan& plan = bench.plan;
  const bool held = e.controller == ControllerVariant::held;
  const ConditionRuns runs = measured(bench, sigma);
  const HealthyLogs healthy = healthy_logs(e, plan.healthy_log_s, sigma);
  ConditionResult result{sigma, {}, {}};
  detect_with_networks(train_paper_detector(bench.paper_generator, e), runs, "paper's recipe", false, result);

  const bool learns = contains(plan.learned_sigmas, sigma);
  Learned learned;
  if (learns) learned = learn_product(healthy, plan.quick, e.seed);
  const Chain identified = learns ? learned.model.robot.chain
                           : held ? identify_robot(healthy).robot.chain
                                  : e.robot.chain;
  detect_with_networks(train_best_detector(best_generator(bench, identified, sigma), runs.training,
                                           plan.patterns_per_class, e.seed),
                       runs, "best recipe", true, result);

  const auto tuning = some_of(runs.tuning, plan.filter_tuning_faulty, plan.filter_tuning_h);
  if (learns) {
    const auto test = some_of(runs.test, plan.filter_faulty, plan.filter_fault_free_h);
    result.detectors.push_back(detect_with_filters(
        detector_name::kFilters,
        with_missed_share(std::get<OneStepModel>(learned.model.explain.robot), healthy.logs), tuning, test));
    for (DetectorResult& detector : detect_with_product(learned, test))
      result.detectors.push_back(std::move(detector));
  }
  if (!contains(plan.filtered_sigmas, sigma)) return result;
  const FilteredRobot known = with_missed_share(known_steps(e.robot, healthy), healthy.logs);
  const auto test = some_of(runs.test, plan.reference_faulty, plan.reference_h);
  result.detectors.push_back(detect_with_filters(detector_name::kReference, known, tuning, test));
  return result;
}

}  // namespace

RunPlan run_plan(ControllerVariant controller, bool quick) {
  RunPlan plan;
  plan.quick = quick;
  const bool held = controller == ControllerVariant::held;
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

std::vector<ConditionResult> run_conditions(ControllerVariant controller, const RunPlan& plan,
                                            std::uint64_t seed) {
  const RunBench bench = run_bench(controller, plan, seed);
  std::vector<ConditionResult> results;
  for (const double sigma : plan.sigmas) results.push_back(run_condition(bench, sigma));
  return results;
}

}  // namespace faultline
