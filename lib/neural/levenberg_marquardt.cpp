// SPDX-License-Identifier: MIT
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lib/neural/normal_equations.hpp"
#include "lib/neural/training.hpp"
#include "lib/neural/training_monitor.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Adds the weight decay to the diagonal entries that belong to weights.
void add_weight_decay(MatrixXd& normal, const Mlp& mlp, double weight_decay) {
  Index at = 0;
  for (const MlpLayer& layer : mlp.layers) {
    normal.diagonal().segment(at, layer.weights.size()).array() += weight_decay;
    at += layer.weights.size() + layer.bias.size();
  }
}

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

/// Solves the normal equations for the step; returns false if they are not positive definite.
bool solve(const MatrixXd& normal, const VectorXd& gradient, double damping, VectorXd& step) {
  MatrixXd damped = normal;
  damped.diagonal().array() += damping;
  Eigen::LLT<Eigen::Ref<MatrixXd>> factor(damped);
  if (factor.info() != Eigen::Success) return false;
  step = factor.solve(-gradient);
  return step.allFinite();
}

}  // namespace

TrainedMlp train_levenberg_marquardt(Mlp start, const Patterns& training, const Patterns& validation,
                                     const LevenbergMarquardtOptions& options, const Progress& progress) {
  TrainingMonitor watch(start,
                        {training, validation, options.stop, progress, "Levenberg-Marquardt training"});
  Mlp mlp = std::move(start);
  VectorXd weights = parameters_of(mlp), step;
  LossGradient now = loss_gradient(mlp, training.inputs, training.targets, options.weight_decay);
  Damping damping;
  for (;;) {
    MatrixXd normal = gauss_newton_matrix(mlp, training.inputs);
    add_weight_decay(normal, mlp, options.weight_decay);
    if (damping.value == 0.0) damping.value = options.initial_damping * normal.diagonal().mean();
    if (now.gradient.norm() < 1e-13) return watch.finish(std::move(mlp), TrainingStop::converged);
    for (int tries = 0;; ++tries) {
      if (tries == 30) {
        set_parameters(mlp, weights);
        return watch.finish(std::move(mlp), TrainingStop::no_descent);
      }
      if (!solve(normal, now.gradient, damping.value, step)) {
        damping.reject();
        continue;
      }
      set_parameters(mlp, weights + step);
      LossGradient next = loss_gradient(mlp, training.inputs, training.targets, options.weight_decay);
      const double promised = 0.5 * step.dot(damping.value * step - now.gradient);
      if (next.loss < now.loss) {
        damping.accept((now.loss - next.loss) / promised);
        weights += step;
        now = std::move(next);
        break;
      }
      damping.reject();
    }
    if (const auto stop = watch.after_iteration(mlp, now.loss)) return watch.finish(std::move(mlp), *stop);
  }
}

}  // namespace faultline
