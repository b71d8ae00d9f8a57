// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "lib/classify/sample_classifier.hpp"
#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/residual/residual_generator.hpp"

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

/// Mean squared error over the four outputs against 0 and 1: training patterns, then test patterns without
/// noise, with sigma 0.01 and with 0.1 (kNoiseVariants).
struct NetworkErrors {
  double training = 0.0;
  std::array<double, 3> test{};
};
struct ClassifierErrors {
  NetworkErrors mlp, rbfn;
};

/// What all recipes under one controller share: robot, scale, the paper's generator, and test patterns.
class ClassifierBench {
 public:
  ClassifierBench(ControllerVariant controller, std::uint64_t seed, int generator_iterations,
                  int test_trajectories);

  ClassifierErrors measure(const ClassifierRecipe& recipe) const;
  /// Root mean square velocity residual of each joint under the paper's generator, in rad/s or m/s.
  Eigen::VectorXd velocity_residual(const Transitions& transitions) const;
  FaultPatterns training_patterns(const ClassifierRecipe& recipe) const;

  const Experiment& experiment() const { return experiment_; }
  /// Test patterns at one of kNoiseVariants, with the mean torque over each sample as for `physics`.
  const FaultPatterns& test(int noise) const { return tests_[noise]; }

 private:
  double torque_phi(RecipeGenerator kind) const;
  ResidualGenerator generator(const ClassifierRecipe& recipe) const;

  Experiment experiment_;
  ResidualGenerator paper_;
  std::array<FaultPatterns, 3> tests_;
};

}  // namespace faultline
