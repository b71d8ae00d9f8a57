// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>
#include <vector>

#include "lib/neural/training.hpp"
#include "lib/neural/training_monitor.hpp"

namespace faultline {

TrainedMlp train_back_propagation(Mlp start, const Patterns& training, const Patterns& validation,
                                  const BackPropagationOptions& options, const Progress& progress) {
  TrainingMonitor watch(start, {training, validation, options.stop, progress, "back-propagation"});
  Mlp mlp = std::move(start);
  Eigen::VectorXd weights = parameters_of(mlp), step = Eigen::VectorXd::Zero(weights.size());
  std::vector<int> order(training.count());
  std::iota(order.begin(), order.end(), 0);
  Random random(options.seed);
  const int batch = std::clamp(options.batch, 1, training.count());
  double rate = options.learning_rate;
  for (;;) {
    shuffle(order, random);
    double loss = 0.0;
    for (int first = 0; first < training.count(); first += batch) {
      const int size = std::min(batch, training.count() - first);
      const std::vector<int> chosen(order.begin() + first, order.begin() + first + size);
      const LossGradient now = loss_gradient(mlp, training.inputs(Eigen::all, chosen),
                                             training.targets(Eigen::all, chosen), options.weight_decay);
      step = options.momentum * step - rate * now.gradient;
      weights += step;
      set_parameters(mlp, weights);
      loss += now.loss * size;
    }
    rate *= options.rate_decay;
    if (const auto stop = watch.after_iteration(mlp, loss / training.count()))
      return watch.finish(std::move(mlp), *stop);
  }
}

}  // namespace faultline
