// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "lib/neural/training.hpp"

namespace faultline {

/// Follows a training: decides when it ends and keeps the weights that did best on the validation patterns.
class TrainingWatch {
 public:
  TrainingWatch(const Mlp& start, const Patterns& training, const Patterns& validation,
                const StopOptions& options, const Progress& progress, const char* what);

  /// After each iteration. A value means: stop, for this reason.
  std::optional<TrainingStop> after_iteration(const Mlp& mlp, double loss);
  /// The result, with the best weights.
  TrainedMlp finish(Mlp last, TrainingStop stop);

 private:
  bool has_validation() const { return validation_.count() > 0; }
  bool stalled(double loss);

  const Patterns& training_;
  const Patterns& validation_;
  const StopOptions& options_;
  const Progress& progress_;
  const char* what_;
  TrainingSummary summary_;
  Mlp best_;
  double best_validation_ = std::numeric_limits<double>::infinity();
  double last_loss_ = std::numeric_limits<double>::infinity();
  int small_falls_ = 0;
};

}  // namespace faultline
