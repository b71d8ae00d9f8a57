// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lib/core/progress.hpp"
#include "lib/neural/mlp.hpp"
#include "lib/neural/patterns.hpp"

namespace faultline {

/// Options of every trainer. All of them also stop when the gradient vanishes, the loss no longer falls or no
/// step lowers it.
struct TrainingOptions {
  int max_iterations = 400;  ///< epochs for back-propagation
  int patience = 20;         ///< iterations without a better error on the validation patterns
  double weight_decay = 0.0;
  std::uint64_t seed = 1;  ///< of the order of the patterns in back-propagation
};

// Each trainer returns the weights with the least mean squared error on the validation patterns, or, without
// such patterns, the last ones.

/// The paper's trainer: gradient descent on mini-batches with momentum.
Mlp train_back_propagation(Mlp start, const Patterns& training, const Patterns& validation,
                           const TrainingOptions& options = {}, const Progress& progress = {});

/// Gauss-Newton with Levenberg's damping (Marquardt 1963), controlled by the gain ratio (Nielsen 1999), for
/// networks with one hidden layer and a linear output: their normal matrix comes from one Gram matrix
/// (docs/neural.md), which makes hundreds of parameters cheap.
Mlp train_levenberg_marquardt(Mlp start, const Patterns& training, const Patterns& validation,
                              const TrainingOptions& options = {}, const Progress& progress = {});

/// Limited-memory BFGS (Liu and Nocedal 1989) on the whole batch: for networks too large for
/// Levenberg-Marquardt, such as classifiers with many inputs.
Mlp train_quasi_newton(Mlp start, const Patterns& training, const Patterns& validation,
                       const TrainingOptions& options = {}, const Progress& progress = {});

}  // namespace faultline
