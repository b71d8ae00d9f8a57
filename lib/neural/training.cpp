// SPDX-License-Identifier: MIT
#include "lib/neural/training.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "lib/neural/normal_equations.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A training has converged after so many falls in succession that are below this share of the loss.
constexpr double kSmallFall = 1e-7;
constexpr int kSmallFalls = 10;

// Of back-propagation.
constexpr double kLearningRate = 0.05;  // step along the gradient of the mean loss of a batch
constexpr double kRateDecay = 0.997;    // factor on the learning rate after each epoch
constexpr double kMomentum = 0.9;
constexpr int kBatch = 16;  // patterns

constexpr double kInitialDamping = 1e-3;  // share of the mean diagonal of the normal matrix
constexpr int kStoredSteps = 12;          // of the quasi-Newton method

/// Inputs of a watch; they must exist as long as the training.
struct MonitoredTraining {
  const Patterns& training;
  const Patterns& validation;
  const TrainingOptions& options;
  const Progress& progress;
  const char* what;  ///< name of the training in progress messages
};

/// Monitors a training: decides when it ends and keeps the weights with the least validation error.
class TrainingMonitor {
 public:
  TrainingMonitor(const Mlp& start, const MonitoredTraining& watched) : watched_(watched), best_(start) {
    check_patterns(watched.training, start.inputs(), start.outputs(), "training patterns");
    if (!has_validation()) return;
    check_patterns(watched.validation, start.inputs(), start.outputs(), "validation patterns");
    best_validation_ = mean_squared_error(start, watched.validation);
  }

  /// Call after each iteration. Returns whether the training ends.
  bool ends_after(const Mlp& mlp, double loss) {
    ++iterations_;
    if (watched_.progress)
      watched_.progress(watched_.what, static_cast<double>(iterations_) / watched_.options.max_iterations);
    if (has_validation()) {
      const double error = mean_squared_error(mlp, watched_.validation);
      if (error < best_validation_) {
        best_validation_ = error;
        best_ = mlp;
        best_iteration_ = iterations_;
      } else if (iterations_ - best_iteration_ >= watched_.options.patience) {
        return true;
      }
    }
    return stalled(loss) || iterations_ >= watched_.options.max_iterations;
  }

  /// Returns the best weights.
  Mlp finish(Mlp last) { return has_validation() ? best_ : std::move(last); }

 private:
  bool has_validation() const { return watched_.validation.count() > 0; }

  bool stalled(double loss) {
    small_falls_ = last_loss_ - loss < kSmallFall * std::fabs(loss) ? small_falls_ + 1 : 0;
    last_loss_ = loss;
    return small_falls_ >= kSmallFalls;
  }

  MonitoredTraining watched_;
  Mlp best_;
  int iterations_ = 0, best_iteration_ = 0;
  double best_validation_ = std::numeric_limits<double>::infinity();
  double last_loss_ = std::numeric_limits<double>::infinity();
  int small_falls_ = 0;
};

/// Damping between Gauss-Newton and gradient descent, adapted to the quadratic model's prediction of a step.
struct Damping {
  double value = 0.0;
  double growth = 2.0;

  void accept(double gain_ratio) {
    const double better = 2.0 * gain_ratio - 1.0;
    value *= std::max(1.0 / 10.0, 1.0 - better * better * better);
    value = std::max(value, 1e-15);
    growth = 2.0;
  }
  void reject() {
    value *= growth;
    growth *= 2.0;
  }
};

struct Pair {
  VectorXd step;
  VectorXd change;  // of the gradient
};

/// The two-loop recursion: minus the approximate inverse Hessian times the gradient.
VectorXd direction(const std::deque<Pair>& memory, const VectorXd& gradient) {
  VectorXd d = -gradient;
  std::vector<double> alpha(memory.size());
  for (std::size_t i = memory.size(); i-- > 0;) {
    alpha[i] = memory[i].step.dot(d) / memory[i].step.dot(memory[i].change);
    d -= alpha[i] * memory[i].change;
  }
  if (!memory.empty()) d *= memory.back().step.dot(memory.back().change) / memory.back().change.squaredNorm();
  for (std::size_t i = 0; i < memory.size(); ++i) {
    const double beta = memory[i].change.dot(d) / memory[i].step.dot(memory[i].change);
    d += (alpha[i] - beta) * memory[i].step;
  }
  return d;
}

struct Point {
  VectorXd weights;
  LossGradient cost;
};

/// Halves the step along `along`, at first `length` of it, until the loss falls by a share of the slope's
/// prediction (Armijo); `at` returns the point with some weights. Empty if no step does.
template <typename At>
std::optional<Point> search(const Point& from, const VectorXd& along, double length, const At& at) {
  const double slope = from.cost.gradient.dot(along);
  for (int halvings = 0; halvings < 40; ++halvings, length *= 0.5) {
    Point found = at(from.weights + length * along);
    if (found.cost.loss <= from.cost.loss + 1e-4 * length * slope) return found;
  }
  return std::nullopt;
}

}  // namespace

Mlp train_back_propagation(Mlp start, const Patterns& training, const Patterns& validation,
                           const TrainingOptions& options, const Progress& progress) {
  TrainingMonitor watch(start, {training, validation, options, progress, "back-propagation"});
  Mlp mlp = std::move(start);
  Eigen::VectorXd weights = parameters_of(mlp), step = Eigen::VectorXd::Zero(weights.size());
  std::vector<int> order(training.count());
  std::iota(order.begin(), order.end(), 0);
  Random random(options.seed);
  const int batch = std::clamp(kBatch, 1, training.count());
  double rate = kLearningRate;
  for (;;) {
    shuffle(order, random);
    double loss = 0.0;
    for (int first = 0; first < training.count(); first += batch) {
      const int size = std::min(batch, training.count() - first);
      const std::vector<int> chosen(order.begin() + first, order.begin() + first + size);
      const LossGradient now = loss_gradient(mlp, training.inputs(Eigen::all, chosen),
                                             training.targets(Eigen::all, chosen), options.weight_decay);
      step = kMomentum * step - rate * now.gradient;
      weights += step;
      set_parameters(mlp, weights);
      loss += now.loss * size;
    }
    rate *= kRateDecay;
    if (watch.ends_after(mlp, loss / training.count())) return watch.finish(std::move(mlp));
  }
}

Mlp train_levenberg_marquardt(Mlp start, const Patterns& training, const Patterns& validation,
                              const TrainingOptions& options, const Progress& progress) {
  TrainingMonitor watch(start, {training, validation, options, progress, "Levenberg-Marquardt training"});
  Mlp mlp = std::move(start);
  mlp.layers.back() = fitted_outputs(mlp, training, options.weight_decay);
  VectorXd weights = parameters_of(mlp);
  LossGradient now = loss_gradient(mlp, training.inputs, training.targets, options.weight_decay);
  Damping damping;
  for (;;) {
    const MatrixXd matrix = hidden_layer_matrix(mlp, training.inputs, options.weight_decay);
    if (damping.value == 0.0) damping.value = kInitialDamping * matrix.diagonal().mean();
    if (now.gradient.norm() < 1e-13) return watch.finish(std::move(mlp));
    for (int tries = 0;; ++tries) {
      if (tries == 30) {
        set_parameters(mlp, weights);
        return watch.finish(std::move(mlp));
      }
      const std::optional<VectorXd> step = gauss_newton_step(matrix, now.gradient, damping.value);
      if (!step) {
        damping.reject();
        continue;
      }
      set_parameters(mlp, weights + *step);
      mlp.layers.back() = fitted_outputs(mlp, training, options.weight_decay);
      LossGradient next = loss_gradient(mlp, training.inputs, training.targets, options.weight_decay);
      const double promised = 0.5 * step->dot(damping.value * *step - now.gradient);
      if (next.loss < now.loss) {
        damping.accept((now.loss - next.loss) / promised);
        weights = parameters_of(mlp);
        now = std::move(next);
        break;
      }
      damping.reject();
    }
    if (watch.ends_after(mlp, now.loss)) return watch.finish(std::move(mlp));
  }
}

Mlp train_quasi_newton(Mlp start, const Patterns& training, const Patterns& validation,
                       const TrainingOptions& options, const Progress& progress) {
  TrainingMonitor watch(start, {training, validation, options, progress, "quasi-Newton training"});
  Mlp mlp = std::move(start);
  const auto at = [&](const VectorXd& weights) {
    set_parameters(mlp, weights);
    return Point{weights, loss_gradient(mlp, training.inputs, training.targets, options.weight_decay)};
  };
  Point now = at(parameters_of(mlp));
  std::deque<Pair> memory;
  for (;;) {
    const VectorXd& gradient = now.cost.gradient;
    if (gradient.norm() < 1e-12) return watch.finish(std::move(mlp));
    VectorXd along = direction(memory, gradient);
    if (along.dot(gradient) >= 0.0) {
      memory.clear();
      along = -gradient;
    }
    std::optional<Point> next =
        search(now, along, memory.empty() ? std::min(1.0, 1.0 / gradient.norm()) : 1.0, at);
    if (!next) {
      set_parameters(mlp, now.weights);
      if (memory.empty()) return watch.finish(std::move(mlp));
      memory.clear();
      continue;
    }
    Pair pair{next->weights - now.weights, next->cost.gradient - gradient};
    if (pair.step.dot(pair.change) > 1e-12 * pair.step.norm() * pair.change.norm())
      memory.push_back(std::move(pair));
    if (static_cast<int>(memory.size()) > kStoredSteps) memory.pop_front();
    now = *std::move(next);
    if (watch.ends_after(mlp, now.cost.loss)) return watch.finish(std::move(mlp));
  }
}

}  // namespace faultline
