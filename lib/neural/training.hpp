// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/neural/mlp.hpp"
#include "lib/neural/patterns.hpp"

namespace faultline {

/// Reason why a training stopped.
enum class TrainingStop {
  not_run,
  target_reached,   ///< the mean squared error over the training patterns fell to the target
  converged,        ///< the gradient vanished or the loss no longer falls
  validation_rose,  ///< no better on the validation patterns for `patience` iterations
  iteration_limit,  ///< not converged within the limit
  no_descent,       ///< no step lowers the loss although the gradient is not zero
};
const char* to_string(TrainingStop stop);

/// Course of a training. Errors are mean squares over patterns and outputs; NaN without patterns.
struct TrainingSummary {
  TrainingStop stop = TrainingStop::not_run;
  int iterations = 0;         ///< of the trainer; epochs for back-propagation
  int best_iteration = 0;     ///< iteration of the returned weights; the last one without validation patterns
  double initial_mse = 0.0;   ///< of the training patterns, before training
  double training_mse = 0.0;  ///< of the training patterns, with the returned weights
  double validation_mse = 0.0;  ///< of the validation patterns, with the returned weights
  std::vector<double> loss;     ///< training loss (with weight decay) after each iteration

  /// Returns one line for a person.
  std::string text() const;
};

struct TrainedMlp {
  Mlp mlp;
  TrainingSummary summary;
};

/// Stop criteria of every trainer.
struct StopOptions {
  int max_iterations = 200;
  double target_mse = 0.0;  ///< 0 = none
  double relative_tolerance =
      1e-7;           ///< converged if the loss falls by less than this share ten times in succession
  int patience = 20;  ///< iterations without a better validation error
};

/// The paper's trainer: gradient descent on mini-batches with momentum.
struct BackPropagationOptions {
  StopOptions stop = {.max_iterations = 1000};  ///< iterations are epochs
  double learning_rate = 0.05;                  ///< step along the gradient of the mean loss of a batch
  double rate_decay = 0.997;                    ///< the learning rate is multiplied by this after each epoch
  double momentum = 0.9;
  double weight_decay = 0.0;
  int batch = 16;          ///< patterns
  std::uint64_t seed = 1;  ///< of the order of the patterns
};
TrainedMlp train_back_propagation(Mlp start, const Patterns& training, const Patterns& validation,
                                  const BackPropagationOptions& options = {}, const Progress& progress = {});

/// Gauss-Newton with Levenberg's damping (Marquardt 1963), controlled by the gain ratio (Nielsen 1999). With
/// one hidden layer and a linear output the normal matrix comes from one Gram matrix (docs/neural.md), which
/// makes hundreds of parameters cheap; other networks use a dense Jacobian and should be small.
struct LevenbergMarquardtOptions {
  StopOptions stop = {.max_iterations = 100};
  double weight_decay = 0.0;
  double initial_damping = 1e-3;  ///< share of the mean diagonal of the normal matrix
};
TrainedMlp train_levenberg_marquardt(Mlp start, const Patterns& training, const Patterns& validation,
                                     const LevenbergMarquardtOptions& options = {},
                                     const Progress& progress = {});

/// Limited-memory BFGS (Liu and Nocedal 1989) on the whole batch: for networks too large for
/// Levenberg-Marquardt, such as classifiers with many inputs.
struct QuasiNewtonOptions {
  StopOptions stop = {.max_iterations = 400};
  double weight_decay = 1e-4;
  int memory = 12;  ///< number of stored steps
};
TrainedMlp train_quasi_newton(Mlp start, const Patterns& training, const Patterns& validation,
                              const QuasiNewtonOptions& options = {}, const Progress& progress = {});

}  // namespace faultline
