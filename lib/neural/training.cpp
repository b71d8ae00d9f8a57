// SPDX-License-Identifier: MIT
#include "lib/neural/training.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "lib/neural/training_monitor.hpp"

namespace faultline {

const char* to_string(TrainingStop stop) {
  switch (stop) {
    case TrainingStop::not_run:
      return "not run";
    case TrainingStop::target_reached:
      return "target reached";
    case TrainingStop::converged:
      return "converged";
    case TrainingStop::validation_rose:
      return "no better on validation patterns";
    case TrainingStop::iteration_limit:
      return "iteration limit";
    case TrainingStop::no_descent:
      return "no step lowers the loss";
  }
  return "not run";
}

std::string TrainingSummary::text() const {
  return fmt::format("{} after {} iterations, training mse {:.3g} -> {:.3g}, validation mse {:.3g}",
                     to_string(stop), iterations, initial_mse, training_mse, validation_mse);
}

TrainingMonitor::TrainingMonitor(const Mlp& start, const MonitoredTraining& watched)
    : watched_(watched), best_(start) {
  const Patterns& training = watched.training;
  const Patterns& validation = watched.validation;
  check_patterns(training, start.inputs(), start.outputs(), "training patterns");
  if (has_validation()) check_patterns(validation, start.inputs(), start.outputs(), "validation patterns");
  summary_.initial_mse = mean_squared_error(start, training);
  if (has_validation()) best_validation_ = mean_squared_error(start, validation);
}

bool TrainingMonitor::stalled(double loss) {
  small_falls_ =
      last_loss_ - loss < watched_.stop.relative_tolerance * std::fabs(loss) ? small_falls_ + 1 : 0;
  last_loss_ = loss;
  return small_falls_ >= 10;
}

std::optional<TrainingStop> TrainingMonitor::after_iteration(const Mlp& mlp, double loss) {
  const int done = ++summary_.iterations;
  summary_.loss.push_back(loss);
  if (watched_.progress)
    watched_.progress(watched_.what, static_cast<double>(done) / watched_.stop.max_iterations);
  if (has_validation()) {
    const double error = mean_squared_error(mlp, watched_.validation);
    if (error < best_validation_) {
      best_validation_ = error;
      best_ = mlp;
      summary_.best_iteration = done;
    } else if (done - summary_.best_iteration >= watched_.stop.patience) {
      return TrainingStop::validation_rose;
    }
  }
  if (watched_.stop.target_mse > 0.0 &&
      mean_squared_error(mlp, watched_.training) <= watched_.stop.target_mse)
    return TrainingStop::target_reached;
  if (stalled(loss)) return TrainingStop::converged;
  if (done >= watched_.stop.max_iterations) return TrainingStop::iteration_limit;
  return std::nullopt;
}

TrainedMlp TrainingMonitor::finish(Mlp last, TrainingStop stop) {
  TrainedMlp trained{has_validation() ? best_ : std::move(last), summary_};
  trained.summary.stop = stop;
  if (!has_validation()) trained.summary.best_iteration = summary_.iterations;
  trained.summary.training_mse = mean_squared_error(trained.mlp, watched_.training);
  trained.summary.validation_mse = has_validation() ? mean_squared_error(trained.mlp, watched_.validation)
                                                    : std::numeric_limits<double>::quiet_NaN();
  return trained;
}

}  // namespace faultline
