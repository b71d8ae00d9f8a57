// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/residual/learn_residual.hpp"
#include "lib/residual/residual_generator.hpp"

namespace faultline {

/// How the generator of the fault-free motion is trained. The default is the paper's: 9-49-6 on 2500
/// patterns, 100 trajectories of 25 samples, that puts out the state one sample later.
struct GeneratorRecipe {
  int trajectories = 100;
  bool runs_of_moves = false;  ///< trained on as many patterns of runs instead, a run for ten trajectories
  double sigma = 0.0;          ///< noise on the training patterns, in half ranges
  bool next_torque = false;    ///< 12-49-6: the torque at the later sample is an input too
  /// Of kinds physics and hybrid: the torque over a sample is tau_k + torque_phi (tau_k+1 - tau_k).
  double torque_phi = 0.0;
  ResidualOptions fit{.target = PredictedQuantity::state};
  /// Robot that kinds physics and hybrid integrate; the true one when empty.
  std::optional<Chain> assumed{};
};

/// Healthy trajectories of 25 samples, with noise if `sigma` is not 0; use generator_training or
/// generator_test.
std::vector<Log> healthy_trajectories(const Experiment& experiment, int count, double sigma, SeedUse use);

/// Healthy runs of moves that hold as many patterns as `trajectories` trajectories do, a run for ten of them.
std::vector<Log> healthy_runs(const Experiment& experiment, int trajectories, double sigma, SeedUse use);

/// The generator of a recipe before its network is trained; that of kind physics is complete.
ResidualGenerator untrained_generator(const Robot& robot, const GeneratorRecipe& recipe);

/// Returns the trained generator, its healthy residuals measured on a fifth as many trajectories again.
ResidualGenerator train_generator(const Experiment& experiment, const GeneratorRecipe& recipe);

/// Mean squared error of each output (q1..qn, dq1..dqn), in squares of half ranges (the paper's measure is
/// the mean of them), of an error given as 2 joints x transitions.
Eigen::VectorXd normalised_mse_by_output(const Eigen::MatrixXd& error, const HalfRanges& ranges);

}  // namespace faultline
