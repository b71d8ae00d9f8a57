// SPDX-License-Identifier: MIT
#include "lib/neural/training.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "lib/neural/training_watch.hpp"

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

TrainingWatch::TrainingWatch(const Mlp& start, const Patterns& training, const Patterns& validation,
                             const StopOptions& options, const Progress& progress, const char* what)
    : training_(training),
      validation_(validation),
      options_(options),
      progress_(progress),
      what_(what),
      best_(start) {
  check_patterns(training, start.inputs(), start.outputs(), "training patterns");
  if (has_validation()) check_patterns(validation, start.inputs(), start.outputs(), "validation patterns");
  summary_.initial_mse = mean_squared_error(start, training);
  if (has_validation()) best_validation_ = mean_squared_error(start, validation);
}

bool TrainingWatch::stalled(double loss) {
  small_falls_ = last_loss_ - loss < options_.relative_tolerance * std::fabs(loss) ? small_falls_ + 1 : 0;
  last_loss_ = loss;
  return small_falls_ >= 10;
}

std::optional<TrainingStop> TrainingWatch::after_iteration(const Mlp& mlp, double loss) {
  const int done = ++summary_.iterations;
  summary_.loss.push_back(loss);
  if (progress_) progress_(what_, static_cast<double>(done) / options_.max_iterations);
  if (has_validation()) {
    const double error = mean_squared_error(mlp, validation_);
    if (error < best_validation_) {
      best_validation_ = error;
      best_ = mlp;
      summary_.best_iteration = done;
    } else if (done - summary_.best_iteration >= options_.patience) {
      return TrainingStop::validation_rose;
    }
  }
  if (options_.target_mse > 0.0 && mean_squared_error(mlp, training_) <= options_.target_mse)
    return TrainingStop::target_reached;
  if (stalled(loss)) return TrainingStop::converged;
  if (done >= options_.max_iterations) return TrainingStop::iteration_limit;
  return std::nullopt;
}

TrainedMlp TrainingWatch::finish(Mlp last, TrainingStop stop) {
  TrainedMlp trained{has_validation() ? best_ : std::move(last), summary_};
  trained.summary.stop = stop;
  if (!has_validation()) trained.summary.best_iteration = summary_.iterations;
  trained.summary.training_mse = mean_squared_error(trained.mlp, training_);
  trained.summary.validation_mse = has_validation() ? mean_squared_error(trained.mlp, validation_)
                                                    : std::numeric_limits<double>::quiet_NaN();
  return trained;
}

}  // namespace faultline
