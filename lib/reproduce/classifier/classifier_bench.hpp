// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "lib/reproduce/classifier/classifier_recipe.hpp"
#include "lib/reproduce/classifier/fault_trajectories.hpp"
#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/residual/residual_generator.hpp"

namespace faultline {

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
