// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include "lib/neural/normal_equations.hpp"
#include "lib/neural/training.hpp"
#include "lib/neural/training_monitor.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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

}  // namespace

TrainedMlp train_levenberg_marquardt(Mlp start, const Patterns& training, const Patterns& validation,
                                     const LevenbergMarquardtOptions& options, const Progress& progress) {
  TrainingMonitor watch(start,
                        {training, validation, options.stop, progress, "Levenberg-Marquardt training"});
  Mlp mlp = std::move(start);
  const bool projected = has_projected_outputs(mlp);
  if (projected) mlp.layers.back() = fitted_outputs(mlp, training, options.weight_decay);
  VectorXd weights = parameters_of(mlp);
  LossGradient now = loss_gradient(mlp, training.inputs, training.targets, options.weight_decay);
  Damping damping;
  for (;;) {
    const GaussNewtonSystem system(mlp, training.inputs, options.weight_decay);
    if (damping.value == 0.0) damping.value = options.initial_damping * system.mean_diagonal();
    if (now.gradient.norm() < 1e-13) return watch.finish(std::move(mlp), TrainingStop::converged);
    for (int tries = 0;; ++tries) {
      if (tries == 30) {
        set_parameters(mlp, weights);
        return watch.finish(std::move(mlp), TrainingStop::no_descent);
      }
      const std::optional<VectorXd> step = system.step(now.gradient, damping.value);
      if (!step) {
        damping.reject();
        continue;
      }
      set_parameters(mlp, weights + *step);
      if (projected) mlp.layers.back() = fitted_outputs(mlp, training, options.weight_decay);
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
    if (const auto stop = watch.after_iteration(mlp, now.loss)) return watch.finish(std::move(mlp), *stop);
  }
}

}  // namespace faultline
