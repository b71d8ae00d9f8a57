// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/core/issue.hpp"
#include "lib/core/progress.hpp"
#include "lib/log/log_source.hpp"
#include "lib/neural/training.hpp"
#include "lib/residual/residual_generator.hpp"
#include "lib/residual/transitions.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {

enum class ResidualTrainer { levenberg_marquardt, back_propagation };

struct ResidualOptions {
  ResidualKind kind = ResidualKind::mlp;
  PredictedQuantity target = PredictedQuantity::change;
  ResidualTrainer trainer = ResidualTrainer::levenberg_marquardt;
  int hidden = 49;          ///< units of the hidden layer
  int max_patterns = 2000;  ///< trained on, drawn from the logs at random
  /// Patterns made by the identified robot around the logged states, as a share of max_patterns: a few logs
  /// cover few moves, and a faulty robot leaves them. Kind mlp on an identified robot only; 0 = logs alone,
  /// as in the paper.
  double twin_share = 0.5;
  int max_iterations = 0;  ///< of the trainer; 0 = 25 (Levenberg-Marquardt) or 1500 epochs (back-propagation)
  double weight_decay = 1e-9;
  std::uint64_t seed = 1;
};

/// Returns the generator, whose kind, target, shape and chain are set, with its network trained on these
/// transitions of healthy motion, all of them finite; scalers take the range of `training`. `validation` may
/// be empty. Kind physics has nothing to train.
ResidualGenerator fit_residual_generator(ResidualGenerator generator, const Transitions& training,
                                         const Transitions& validation, const ResidualOptions& options,
                                         const Progress& progress = {});

/// Returns the residuals of the generator on transitions of healthy motion that were not trained on. Its own
/// `healthy` may be empty.
HealthyResiduals healthy_residuals(ResidualGenerator generator, const Transitions& check);

/// A trained generator, and how well it predicts healthy motion.
struct LearnedResidual {
  ResidualGenerator generator;
  int training_patterns = 0;
  /// Mean squared error over q and dq after a step, each in units of half its range, on patterns that were
  /// not trained on: of the generator, and of the prediction that nothing changes.
  double normalised_mse = 0.0;
  double persistence_mse = 0.0;
};

/// Learns the fault-free motion of a robot from its healthy logs, streaming them twice (they are rewound
/// first). Logs are cut into blocks of up to 3 s, so that whole moves stay together; of each ten blocks seven
/// train, one validates, two measure the healthy residuals. Throws Error(input) when the logs have other
/// joints, no torque or too few rows.
LearnedResidual learn_residual_generator(std::span<LogSource* const> logs, const Robot& identified,
                                         double torque_phi, const ResidualOptions& options = {},
                                         const Progress& progress = {});

}  // namespace faultline
