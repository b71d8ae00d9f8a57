// SPDX-License-Identifier: MIT
#include <cmath>
#include <deque>
#include <utility>

#include "lib/neural/training.hpp"
#include "lib/neural/training_watch.hpp"

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

/// Halves the step until the loss falls by a share of what the slope promises (Armijo). False when it never
/// does.
bool search(Mlp& mlp, const VectorXd& from, const VectorXd& along, const LossGradient& start, double length,
            const Patterns& patterns, double weight_decay, LossGradient& found, VectorXd& at) {
  const double slope = start.gradient.dot(along);
  for (int halvings = 0; halvings < 40; ++halvings, length *= 0.5) {
    at = from + length * along;
    set_parameters(mlp, at);
    found = loss_gradient(mlp, patterns.inputs, patterns.targets, weight_decay);
    if (found.loss <= start.loss + 1e-4 * length * slope) return true;
  }
  set_parameters(mlp, from);
  return false;
}

}  // namespace

TrainedMlp train_quasi_newton(Mlp start, const Patterns& training, const Patterns& validation,
                              const QuasiNewtonOptions& options, const Progress& progress) {
  TrainingWatch watch(start, training, validation, options.stop, progress, "quasi-Newton training");
  Mlp mlp = std::move(start);
  VectorXd weights = parameters_of(mlp), next_weights;
  LossGradient now = loss_gradient(mlp, training.inputs, training.targets, options.weight_decay), next;
  std::deque<Pair> memory;
  for (;;) {
    if (now.gradient.norm() < 1e-12) return watch.finish(std::move(mlp), TrainingStop::converged);
    VectorXd along = direction(memory, now.gradient);
    if (along.dot(now.gradient) >= 0.0) {
      memory.clear();
      along = -now.gradient;
    }
    const double first_length = memory.empty() ? std::min(1.0, 1.0 / now.gradient.norm()) : 1.0;
    if (!search(mlp, weights, along, now, first_length, training, options.weight_decay, next, next_weights)) {
      if (memory.empty()) return watch.finish(std::move(mlp), TrainingStop::no_descent);
      memory.clear();
      continue;
    }
    Pair pair{next_weights - weights, next.gradient - now.gradient};
    if (pair.step.dot(pair.change) > 1e-12 * pair.step.norm() * pair.change.norm())
      memory.push_back(std::move(pair));
    if (static_cast<int>(memory.size()) > options.memory) memory.pop_front();
    std::swap(weights, next_weights);
    std::swap(now, next);
    if (const auto stop = watch.after_iteration(mlp, now.loss)) return watch.finish(std::move(mlp), *stop);
  }
}

}  // namespace faultline
