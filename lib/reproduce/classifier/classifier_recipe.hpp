// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lib/classify/sample_classifier.hpp"
#include "lib/reproduce/classifier/fault_trajectories.hpp"

namespace faultline {

/// What predicts the fault-free sample.
enum class RecipeGenerator {
  paper,         ///< the MLP 9-49-6 on 2500 clean patterns
  physics_held,  ///< the robot with its parameters known, the torque constant over the sample
  physics,       ///< the same, the torque moving to that of the next sample where it does (fast and pd)
};

/// One way to build the classifier of single samples.
struct ClassifierRecipe {
  std::string name;
  RecipeGenerator generator = RecipeGenerator::paper;
  SampleClassifierOptions classifier{};
  int trajectories = kTable1Trajectories;  ///< of ten training patterns each
  double sigma = 0.0;                      ///< noise on the training patterns, half ranges
};

/// Places in classifier_recipes that results refer to.
enum RecipePlace {
  kPaperRecipe = 0,
  kBestCleanRecipe = 5,    ///< trained on 900 patterns without noise
  kPaperManyRecipe = 7,    ///< on many patterns of sigma 0.01, with the paper's generator
  kBestNoisyRecipe = 8,    ///< trained on 900 patterns of sigma 0.01
  kBestManyRecipe = 9,     ///< and on many
  kBestCoarseRecipe = 10,  ///< on 900 of sigma 0.1
  kBestManyCoarseRecipe = 11,
};
struct RecipeEffort {
  int many = 1200;       ///< trajectories behind the recipes with as many noisy patterns as help
  int epochs = 1500;     ///< of back-propagation
  int iterations = 400;  ///< of the quasi-Newton trainer
};
/// The paper's recipe and departures from it up to kBestCleanRecipe, each added to the one before; then those
/// trained with noise.
std::vector<ClassifierRecipe> classifier_recipes(const RecipeEffort& effort = {});

}  // namespace faultline
