// SPDX-License-Identifier: MIT
#include "lib/reproduce/runs/sample_detector.hpp"

#include "lib/reproduce/classifier/fault_trajectories.hpp"
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

}  // namespace faultline
