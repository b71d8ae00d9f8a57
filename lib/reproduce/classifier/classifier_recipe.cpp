// SPDX-License-Identifier: MIT
#include "lib/reproduce/classifier/classifier_recipe.hpp"

#include <limits>

namespace faultline {
namespace {

SampleClassifierOptions classifier_options(SampleFeatures features, double weight_decay, int iterations) {
  SampleClassifierOptions options{.features = features};
  options.rbfn.map = {.rows = 12, .columns = 12};
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
  recipe.classifier.hidden = {30};
  recipe.classifier.max_iterations = recipe.classifier.max_iterations * 5 / 8;
  recipe.classifier.rbfn.map.rows = recipe.classifier.rbfn.map.columns = 14;
  recipe.classifier.rbfn.map.epochs = 5;
  return recipe;
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

}  // namespace faultline
