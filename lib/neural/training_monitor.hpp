// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "lib/neural/training.hpp"

namespace faultline {

/// Inputs of a watch; they must exist as long as the training.
struct MonitoredTraining {
  const Patterns& training;
  const Patterns& validation;
  const StopOptions& stop;
  const Progress& progress;
  const char* what;  ///< name of the training in progress messages
};

/// Monitors a training: decides when it ends and keeps the weights with the least validation error.
class TrainingMonitor {
 public:
  TrainingMonitor(const Mlp& start, const MonitoredTraining& watched);

  /// Call after each iteration. Returns the reason to stop, if there is one.
  std::optional<TrainingStop> after_iteration(const Mlp& mlp, double loss);
  /// Returns the result with the best weights.
  TrainedMlp finish(Mlp last, TrainingStop stop);

 private:
  bool has_validation() const { return watched_.validation.count() > 0; }
  bool stalled(double loss);

  MonitoredTraining watched_;
  TrainingSummary summary_;
  Mlp best_;
  double best_validation_ = std::numeric_limits<double>::infinity();
  double last_loss_ = std::numeric_limits<double>::infinity();
  int small_falls_ = 0;
};

}  // namespace faultline
