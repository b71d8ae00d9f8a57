// SPDX-License-Identifier: MIT
#include "lib/reproduce/classifier/classifier_bench.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "lib/reproduce/protocol/motion_generator.hpp"
#include "lib/residual/learn_residual.hpp"

namespace faultline {
namespace {

SampleClassifierOptions classifier_options(SampleFeatures features, double weight_decay, int iterations) {
  SampleClassifierOptions options{.features = features};
  options.map = {.rows = 12, .columns = 12};
  options.patterns_per_class = std::numeric_limits<int>::max();
  options.validate_every = 0;
  options.max_iterations = iterations;
  options.weight_decay = weight_decay;
  return options;
}

ClassifierRecipe as_in_the_paper(int epochs) {
  ClassifierRecipe paper{.name = "as in the paper",
                         .classifier = classifier_options(SampleFeatures::velocity, 0.0, epochs)};
  paper.classifier.output = OutputKind::linear;
  paper.classifier.trainer = SampleTrainer::back_propagation;
  return paper;
}

ClassifierRecipe noisy(const ClassifierRecipe& clean, double sigma, double weight_decay) {
  ClassifierRecipe recipe = clean;
  recipe.sigma = sigma;
  recipe.classifier.weight_decay = weight_decay;
  return recipe;
}

ClassifierRecipe with_many(ClassifierRecipe recipe, int trajectories) {
  recipe.trajectories = trajectories;
  recipe.classifier.weight_decay = 1e-5;
  recipe.classifier.hidden = 30;
  recipe.classifier.max_iterations = recipe.classifier.max_iterations * 5 / 8;
  recipe.classifier.map.rows = recipe.classifier.map.columns = 14;
  recipe.classifier.map.epochs = 5;
  return recipe;
}

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kLinearTorque = 0.5;       // torque_phi of a torque that moves straight to the next sample's
constexpr double kLeastTorqueScale = 0.01;  // of the torque's half range: features resolve no finer
constexpr int kHealthyCheck = 20;           // trajectories that measure the healthy residuals

/// The same patterns seen with the torque constant over each sample.
Transitions with_held_torque(Transitions transitions) {
  transitions.mean_tau = transitions.tau;
  return transitions;
}

std::vector<LabelledResiduals> labelled(const ResidualGenerator& generator, const FaultPatterns& patterns) {
  std::vector<LabelledResiduals> runs;
  for (int output = 0; output < kFaultClasses; ++output) {
    Transitions transitions = patterns.of_class[output];
    if (generator.shape.torque_phi == 0.0) transitions = with_held_torque(std::move(transitions));
    runs.push_back({.residuals = residuals_of(generator, transitions),
                    .fault = fault_of_class(output),
                    .onset_s = -std::numeric_limits<double>::infinity()});
  }
  return runs;
}

double squared_error(MatrixXd outputs, int right) {
  outputs.row(right).array() -= 1.0;
  return outputs.squaredNorm();
}

/// Of the MLP, then of the RBFN.
std::array<double, 2> errors(const SampleClassifier& classifier, const std::vector<LabelledResiduals>& runs) {
  std::array<double, 2> sum{};
  Index count = 0;
  for (int right = 0; right < kFaultClasses; ++right) {
    const SampleOutputs outputs = classify_samples(classifier, runs[right].residuals);
    sum[0] += squared_error(outputs.mlp, right);
    sum[1] += squared_error(outputs.rbfn, right);
    count += outputs.mlp.size();
  }
  return {sum[0] / static_cast<double>(count), sum[1] / static_cast<double>(count)};
}

}  // namespace

std::vector<ClassifierRecipe> classifier_recipes(const RecipeEffort& effort) {
  const auto clean = [&](const char* name, RecipeGenerator generator, SampleFeatures features, double decay) {
    return ClassifierRecipe{.name = name,
                            .generator = generator,
                            .classifier = classifier_options(features, decay, effort.iterations)};
  };
  using enum RecipeGenerator;
  const auto both = clean("+ features of both hypotheses", paper, SampleFeatures::hypotheses, 3e-4);
  const auto best = clean("+ torque of the next sample", physics, SampleFeatures::hypotheses, 3e-4);
  return {as_in_the_paper(effort.epochs),
          clean("+ softmax outputs, quasi-Newton", paper, SampleFeatures::velocity, 1e-5),
          clean("+ torque space and ratio", paper, SampleFeatures::torque_space, 1e-4),
          both,
          clean("+ physics in place of the network", physics_held, SampleFeatures::hypotheses, 3e-4),
          best,
          noisy(both, 0.01, 1e-3),
          with_many(noisy(both, 0.01, 0.0), effort.many),
          noisy(best, 0.01, 1e-3),
          with_many(noisy(best, 0.01, 0.0), effort.many),
          noisy(best, 0.1, 1e-2),
          with_many(noisy(best, 0.1, 0.0), effort.many)};
}

ClassifierBench::ClassifierBench(ControllerVariant controller, std::uint64_t seed, int generator_iterations,
                                 int test_trajectories)
    : experiment_(experiment_on(bench_robot(), controller, seed)) {
  GeneratorRecipe recipe;
  recipe.fit.max_iterations = generator_iterations;
  paper_ = train_generator(experiment_, recipe);
  for (int noise = 0; noise < 3; ++noise)
    tests_[noise] = fault_patterns(experiment_,
                                   {.count = test_trajectories,
                                    .sigma = kNoiseVariants[noise],
                                    .torque_phi = torque_phi(RecipeGenerator::physics)},
                                   SeedUse::classifier_test);
}

double ClassifierBench::torque_phi(RecipeGenerator kind) const {
  const bool moves = kind == RecipeGenerator::physics && experiment_.controller != ControllerVariant::held;
  return moves ? kLinearTorque : 0.0;
}

/// With the healthy residuals that the noise of use leaves: they set the scale of the features.
ResidualGenerator ClassifierBench::generator(const ClassifierRecipe& recipe) const {
  ResidualGenerator generator = paper_;
  if (recipe.generator != RecipeGenerator::paper) generator.kind = ResidualKind::physics;
  generator.shape.torque_phi = torque_phi(recipe.generator);
  const auto check = healthy_trajectories(experiment_, kHealthyCheck, recipe.sigma, SeedUse::learning_logs);
  generator.healthy = healthy_residuals(generator, transitions_of(check, generator.shape.torque_phi));
  Eigen::VectorXd& scale = generator.healthy.torque_rms;
  scale = scale.cwiseMax(kLeastTorqueScale * experiment_.ranges.tau);
  return generator;
}

FaultPatterns ClassifierBench::training_patterns(const ClassifierRecipe& recipe) const {
  const FaultTrajectories trajectories{recipe.trajectories, recipe.sigma, torque_phi(recipe.generator)};
  return fault_patterns(experiment_, trajectories, SeedUse::classifier_training);
}

ClassifierErrors ClassifierBench::measure(const ClassifierRecipe& recipe) const {
  const ResidualGenerator generator = this->generator(recipe);
  const auto training = labelled(generator, training_patterns(recipe));
  SampleClassifierOptions options = recipe.classifier;
  options.seed = options.map.seed = seed_of(experiment_.seed, SeedUse::classifier_training, ~0ull);
  const SampleClassifier classifier = train_sample_classifier(training, generator, options);
  ClassifierErrors result;
  const auto trained = errors(classifier, training);
  result.mlp.training = trained[0];
  result.rbfn.training = trained[1];
  for (int noise = 0; noise < 3; ++noise) {
    const auto tested = errors(classifier, labelled(generator, tests_[noise]));
    result.mlp.test[noise] = tested[0];
    result.rbfn.test[noise] = tested[1];
  }
  return result;
}

Eigen::VectorXd ClassifierBench::velocity_residual(const Transitions& transitions) const {
  const Residuals residuals = residuals_of(paper_, with_held_torque(transitions));
  const Eigen::VectorXd rms = residuals.velocity.rowwise().norm() / std::sqrt(residuals.count());
  return rms.cwiseProduct(paper_.healthy.velocity_rms);
}

}  // namespace faultline
