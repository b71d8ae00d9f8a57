// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "lib/neural/training.hpp"

namespace faultline {

/// What a watch looks at; borrowed for as long as the training lasts.
struct WatchedTraining {
  const Patterns& training;
  const Patterns& validation;
  const StopOptions& stop;
  const Progress& progress;
  const char* what;  ///< as progress names it
};

/// Follows a training: decides when it ends and keeps the weights that did best on the validation patterns.
class TrainingWatch {
 public:
  TrainingWatch(const Mlp& start, const WatchedTraining& watched);

  /// After each iteration. A value means: stop, for this reason.
  std::optional<TrainingStop> after_iteration(const Mlp& mlp, double loss);
  /// The result, with the best weights.
  TrainedMlp finish(Mlp last, TrainingStop stop);

 private:
  bool has_validation() const { return watched_.validation.count() > 0; }
  bool stalled(double loss);

  WatchedTraining watched_;
  TrainingSummary summary_;
  Mlp best_;
  double best_validation_ = std::numeric_limits<double>::infinity();
  double last_loss_ = std::numeric_limits<double>::infinity();
  int small_falls_ = 0;
};

}  // namespace faultline
