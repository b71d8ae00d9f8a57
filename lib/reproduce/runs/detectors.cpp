// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/detectors.hpp"

#include <algorithm>

#include "lib/classify/episode_features.hpp"
#include "lib/diagnose/decide_episode.hpp"
#include "lib/diagnose/monitor/monitor.hpp"
#include "lib/identify/days/fit_coarse_days.hpp"
#include "lib/log/log_source.hpp"
#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

// Trajectories with a fault in joint 1, 2, 3 and without; every fifth of each validates, which leaves 20, 20,
// 35 and 15 to train on.
constexpr int kTrajectories[kFaultClasses] = {25, 25, 43, 18};
constexpr int kAllPatterns = 1'000'000;
constexpr int kIterations = 200;

LabelledResiduals residuals_of_log(const ResidualGenerator& generator, const Log& log,
                                   const FaultLabel& fault, double onset_s) {
  ResidualState state;
  return {.residuals = compute_residuals(generator, log, state), .fault = fault, .onset_s = onset_s};
}

constexpr int kHealthyLogs = 3;
constexpr std::uint64_t kDetectorNoise = 100;
constexpr int kHealthyRuns = 10;  // simulated to calibrate the threshold

/// Healthy logs as the stages read them.
class Sources {
 public:
  explicit Sources(const HealthyLogs& healthy) {
    for (const Log& log : healthy.logs) sources_.emplace_back(log, "healthy");
    for (MemorySource& source : sources_) pointers_.push_back(&source);
  }
  const std::vector<LogSource*>& all() const { return pointers_; }

 private:
  std::vector<MemorySource> sources_;
  std::vector<LogSource*> pointers_;
};

/// With noise of a tenth of the range shooting creeps on for long without a gain that the detectors feel.
IdentifyOptions identify_options() {
  IdentifyOptions options;
  options.threads = 1;
  options.max_iterations = 12;
  return options;
}

}  // namespace

SampleDetector train_paper_detector(const ResidualGenerator& generator, const Experiment& experiment) {
  std::vector<LabelledResiduals> runs;
  for (int output = 0; output < kFaultClasses; ++output) {
    const FaultLabel fault = fault_of_class(output);
    for (int i = 0; i < kTrajectories[output]; ++i) {
      const std::uint64_t own = seed_of(experiment.seed, SeedUse::classifier_training, 1000 * output + i);
      const Log log =
          trajectory(experiment.robot, experiment.controller, kPatternsPerTrajectory, own, {fault});
      runs.push_back(residuals_of_log(generator, log, fault, 0.0));
    }
  }
  SampleClassifierOptions options;
  options.features = SampleFeatures::velocity;
  options.output = OutputKind::linear;
  options.patterns_per_class = kAllPatterns;
  options.max_iterations = kIterations;
  options.seed = experiment.seed;
  return {generator, train_sample_classifier(runs, generator, options)};
}

SampleDetector train_best_detector(const ResidualGenerator& generator, std::span<const ExperimentRun> runs,
                                   int patterns_per_class, std::uint64_t seed) {
  std::vector<LabelledResiduals> residuals;
  for (const ExperimentRun& run : runs)
    residuals.push_back(residuals_of_log(generator, run.log, run.fault, run.onset_s));
  SampleClassifierOptions options;
  options.patterns_per_class = patterns_per_class;
  options.max_iterations = kIterations;
  options.seed = seed;
  return {generator, train_sample_classifier(residuals, generator, options)};
}

SampleOutputs outputs_of(const SampleDetector& detector, const Log& log) {
  ResidualState state;
  return classify_samples(detector.classifier, compute_residuals(detector.generator, log, state));
}

HealthyLogs healthy_logs(const Experiment& experiment, double duration_s, double sigma) {
  const auto& [robot, controller, ranges, seed] = experiment;
  HealthyLogs healthy;
  for (std::uint64_t i = 0; i < kHealthyLogs; ++i) {
    healthy.logs.push_back(
        run_of_moves(robot, controller, {duration_s}, seed_of(seed, SeedUse::learning_logs, i)));
    add_noise(healthy.logs.back(), ranges, sigma, seed_of(seed, SeedUse::learning_logs, kDetectorNoise + i));
  }
  healthy.robot = preset_robot(robot.axes);
  healthy.robot.name = robot.name;
  healthy.robot.known["l1"] = {robot.chain.length[0], 0.0};
  healthy.robot.log.torque_between_samples =
      controller == ControllerVariant::held ? TorqueTiming::held : TorqueTiming::unknown;
  return healthy;
}

Learned learn_product(const HealthyLogs& healthy, bool quick, std::uint64_t seed) {
  LearnOptions options;
  options.threads = 1;
  options.identify = identify_options();
  options.runs_per_label = 4;
  options.validation_per_label = 0;
  options.healthy_runs = quick ? 4 : kHealthyRuns;
  options.residual.max_iterations = quick ? 8 : 30;
  if (quick) options.residual.max_patterns = 600;
  if (quick) options.kinds = {FaultKind::free_swinging, FaultKind::torque_loss, FaultKind::locked};
  options.seed = seed;
  const Sources sources(healthy);
  return learn(sources.all(), {}, healthy.robot, options);
}

Identification identify_robot(const HealthyLogs& healthy) {
  const Sources sources(healthy);
  return identify(sources.all(), healthy.robot, identify_options());
}

OneStepModel known_steps(const Robot& robot, const HealthyLogs& healthy) {
  const Sources sources(healthy);
  const ParameterSpace space = parameter_space(robot);
  OneStepModel steps = fit_coarse_days(sources.all(), robot, space, healthy.robot.log.torque_between_samples);
  const Eigen::VectorXd truth = parameters_of(space, robot.chain, 0.0);
  Eigen::VectorXd width(space.joints());
  int at = 0;
  for (int p = 0; p < space.rigid(); ++p)
    if (!space.base[p].is_rotor) steps.theta[at++] = truth[p];
  for (int j = 0; j < space.joints(); ++j) {
    const Friction& friction = robot.chain.friction[j];
    steps.theta[steps.layout().viscous(j)] = friction.viscous;
    steps.theta[steps.layout().coulomb(j)] = friction.coulomb;
    width[j] = friction.width;
  }
  steps.body = MotionBody(steps.body.rigid(), width);
  return steps;
}

ProductAlarms product_alarms(const Learned& learned, const Log& log) {
  const Model& model = learned.model;
  MemorySource source(log, "run");
  ProductAlarms alarms;
  for (const MonitoredEpisode& observed : monitor(source, model).episodes) {
    const double alarm_s = observed.alarm_s();
    const Episode episode = describe_episode(observed, model).episode;
    alarms.mlp.push_back({alarm_s, episode.mlp.label});
    alarms.rbfn.push_back({alarm_s, episode.rbfn.label});
    alarms.cases.push_back({alarm_s, decide_episode(observed, model, learned.cases).label});
  }
  return alarms;
}

}  // namespace faultline
