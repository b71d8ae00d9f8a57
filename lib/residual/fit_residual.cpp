// SPDX-License-Identifier: MIT
#include "lib/residual/fit_residual.hpp"

#include <utility>
#include <vector>

#include "lib/residual/residuals.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Training targets of the network for each transition, in SI units.
MatrixXd network_targets(const ResidualGenerator& generator, const Transitions& transitions) {
  const MatrixXd change = measured_change(generator, transitions);
  if (generator.kind == ResidualKind::mlp && generator.target == PredictedQuantity::state) {
    MatrixXd state = change;
    state.topRows(generator.joints()) += transitions.q;
    state.bottomRows(generator.joints()) += transitions.dq;
    return state;
  }
  return change - base_change(generator, transitions);
}

Patterns scaled_patterns(const ResidualGenerator& generator, const Transitions& transitions) {
  return {generator.inputs.apply(network_inputs(generator, transitions)),
          generator.outputs.apply(network_targets(generator, transitions))};
}

TrainedMlp train_network(const Patterns& training, const Patterns& validation, const ResidualOptions& options,
                         const Progress& progress) {
  std::vector<int> sizes{static_cast<int>(training.inputs.rows())};
  sizes.insert(sizes.end(), options.hidden.begin(), options.hidden.end());
  sizes.push_back(static_cast<int>(training.targets.rows()));
  Mlp start = make_mlp(sizes, OutputKind::linear, options.seed);
  if (options.trainer == ResidualTrainer::back_propagation) {
    BackPropagationOptions trainer{.weight_decay = options.weight_decay, .seed = options.seed};
    trainer.stop.max_iterations = options.max_iterations > 0 ? options.max_iterations : 1500;
    trainer.stop.patience = trainer.stop.max_iterations;
    return train_back_propagation(std::move(start), training, validation, trainer, progress);
  }
  LevenbergMarquardtOptions trainer{.weight_decay = options.weight_decay};
  trainer.stop.max_iterations = options.max_iterations > 0 ? options.max_iterations : 25;
  return train_levenberg_marquardt(std::move(start), training, validation, trainer, progress);
}

VectorXd rms_of(const MatrixXd& values) { return values.array().square().rowwise().mean().sqrt().matrix(); }
VectorXd largest_of(const MatrixXd& values) { return values.cwiseAbs().rowwise().maxCoeff(); }

}  // namespace

FittedGenerator fit_residual_generator(ResidualGenerator untrained, const Transitions& training,
                                       const Transitions& validation, const ResidualOptions& options,
                                       const Progress& progress) {
  FittedGenerator out{std::move(untrained), {}};
  ResidualGenerator& generator = out.generator;
  if (generator.kind == ResidualKind::physics) return out;
  generator.inputs = range_scaler(network_inputs(generator, training));
  generator.outputs = range_scaler(network_targets(generator, training));
  Patterns held_back;
  if (validation.count() > 0) held_back = scaled_patterns(generator, validation);
  TrainedMlp trained = train_network(scaled_patterns(generator, training), held_back, options, progress);
  generator.mlp = std::move(trained.mlp);
  out.training = std::move(trained.summary);
  return out;
}

HealthyResiduals healthy_residuals(ResidualGenerator generator, const Transitions& check) {
  const Index n = generator.joints();
  HealthyResiduals& healthy = generator.healthy;
  healthy.patterns = check.count();
  healthy.position_rms = healthy.velocity_rms = healthy.torque_rms =
      VectorXd::Ones(n);  // so that units stay SI
  const Residuals r = residuals_of(generator, check);
  // A residual of exactly zero (a joint that never moved) must not become a division by zero.
  const auto at_least = [](const VectorXd& rms) -> VectorXd { return rms.cwiseMax(1e-12); };
  healthy.position_rms = at_least(rms_of(r.position));
  healthy.velocity_rms = at_least(rms_of(r.velocity));
  healthy.torque_rms = at_least(rms_of(r.torque));
  healthy.position_max = largest_of(r.position);
  healthy.velocity_max = largest_of(r.velocity);
  healthy.torque_max = largest_of(r.torque);
  return healthy;
}

}  // namespace faultline
