// SPDX-License-Identifier: MIT
#include <cmath>
#include <deque>
#include <utility>

#include "lib/neural/training.hpp"
#include "lib/neural/training_monitor.hpp"

namespace faultline {
namespace {

using Eigen::VectorXd;

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

/// The function to be minimised.
struct Objective {
  const Patterns& patterns;
  double weight_decay = 0.0;

  LossGradient at(const Mlp& mlp) const {
    return loss_gradient(mlp, patterns.inputs, patterns.targets, weight_decay);
  }
};

/// Direction and initial length of a line search.
struct Ray {
  VectorXd along;
  double length = 1.0;
};

/// Halves the step until the loss falls by a share of the slope's prediction (Armijo). Returns false, with
/// the old weights, if no step does.
bool search(Mlp& mlp, const Objective& objective, const Point& from, const Ray& ray, Point& found) {
  const double slope = from.cost.gradient.dot(ray.along);
  double length = ray.length;
  for (int halvings = 0; halvings < 40; ++halvings, length *= 0.5) {
    found.weights = from.weights + length * ray.along;
    set_parameters(mlp, found.weights);
    found.cost = objective.at(mlp);
    if (found.cost.loss <= from.cost.loss + 1e-4 * length * slope) return true;
  }
  set_parameters(mlp, from.weights);
  return false;
}

}  // namespace

TrainedMlp train_quasi_newton(Mlp start, const Patterns& training, const Patterns& validation,
                              const QuasiNewtonOptions& options, const Progress& progress) {
  TrainingMonitor watch(start, {training, validation, options.stop, progress, "quasi-Newton training"});
  Mlp mlp = std::move(start);
  const Objective objective{training, options.weight_decay};
  Point now{parameters_of(mlp), objective.at(mlp)}, next;
  std::deque<Pair> memory;
  for (;;) {
    if (now.cost.gradient.norm() < 1e-12) return watch.finish(std::move(mlp), TrainingStop::converged);
    Ray ray{direction(memory, now.cost.gradient)};
    if (ray.along.dot(now.cost.gradient) >= 0.0) {
      memory.clear();
      ray.along = -now.cost.gradient;
    }
    if (memory.empty()) ray.length = std::min(1.0, 1.0 / now.cost.gradient.norm());
    if (!search(mlp, objective, now, ray, next)) {
      if (memory.empty()) return watch.finish(std::move(mlp), TrainingStop::no_descent);
      memory.clear();
      continue;
    }
    Pair pair{next.weights - now.weights, next.cost.gradient - now.cost.gradient};
    if (pair.step.dot(pair.change) > 1e-12 * pair.step.norm() * pair.change.norm())
      memory.push_back(std::move(pair));
    if (static_cast<int>(memory.size()) > options.memory) memory.pop_front();
    std::swap(now, next);
    if (const auto stop = watch.after_iteration(mlp, now.cost.loss))
      return watch.finish(std::move(mlp), *stop);
  }
}

}  // namespace faultline
