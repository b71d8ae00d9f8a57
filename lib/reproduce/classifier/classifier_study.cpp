// SPDX-License-Identifier: MIT
#include <limits>

#include "lib/reproduce/classifier/classifier_results.hpp"
#include "lib/reproduce/classifier/transition_posterior.hpp"

namespace faultline {
namespace {

/// How much is done; less in a quick run.
struct Effort {
  RecipeEffort recipes{};
  int generator_iterations = 60;
  int test_trajectories = 500;   ///< of ten patterns
  int posterior_learning = 720;  ///< trajectories
  int posterior_test = 180;
};

Effort effort_of(const ReproduceOptions& options) {
  if (!options.quick) return {};
  return {.recipes = {.many = 300, .epochs = 200, .iterations = 100},
          .generator_iterations = 12,
          .test_trajectories = 90,
          .posterior_learning = 90,
          .posterior_test = 45};
}

std::array<double, 3> posterior_errors(const Experiment& experiment, TorqueBetween between,
                                       const Effort& effort) {
  FaultTrajectories set{.count = effort.posterior_learning, .torque_phi = 0.5};
  const auto draw = [&](SeedUse use) { return fault_patterns(experiment, set, use); };
  const TransitionModel model = learn_transition_model(
      SampleModel(experiment.robot, experiment.controller, between), draw(SeedUse::classifier_training));
  set.count = effort.posterior_test;
  std::array<double, 3> errors{};
  for (int noise = 0; noise < 3; ++noise) {
    set.sigma = kNoiseVariants[noise];
    errors[noise] = posterior_error(model, draw(SeedUse::classifier_test), experiment.ranges, set.sigma);
  }
  return errors;
}

ClassifierFindings find(ControllerVariant controller, const std::vector<ClassifierRecipe>& recipes,
                        const Effort& effort, std::uint64_t seed) {
  const ClassifierBench bench(controller, seed, effort.generator_iterations, effort.test_trajectories);
  ClassifierFindings found;
  const FaultPatterns training = bench.training_patterns(recipes[kPaperRecipe]);
  for (int output = 0; output < kFaultClasses; ++output) {
    found.patterns[output] = training.of_class[output].count();
    found.velocity_residual[output] = bench.velocity_residual(training.of_class[output]);
  }
  for (const ClassifierRecipe& recipe : recipes) found.by_recipe.push_back(bench.measure(recipe));
  found.posterior = posterior_errors(bench.experiment(), TorqueBetween::controlled, effort);
  found.posterior_next.fill(std::numeric_limits<double>::quiet_NaN());
  if (controller != ControllerVariant::held)
    found.posterior_next = posterior_errors(bench.experiment(), TorqueBetween::linear, effort);
  return found;
}

}  // namespace

StudyResult classifier_study(const ReproduceOptions& options, const Progress& progress) {
  options.check();
  const Effort effort = effort_of(options);
  const std::vector<ClassifierRecipe> recipes = classifier_recipes(effort.recipes);
  ClassifierResults results(recipes, options.seeds);
  const int items = kControllers * options.seeds;
  parallel_steps("classifiers of single samples", items, options.threads, progress, [&](int item) {
    const int controller = item % kControllers, seed = item / kControllers;
    results.at(controller, seed) = find(kControllerVariants[controller], recipes, effort,
                                        options.seed + static_cast<std::uint64_t>(seed));
  });
  return results.tables_and_goals();
}

}  // namespace faultline
