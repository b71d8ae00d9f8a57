// SPDX-License-Identifier: MIT
#include "lib/reproduce/protocol/motion_generator.hpp"

#include <utility>

#include "lib/residual/learn_residual.hpp"

namespace faultline {
namespace {

constexpr int kSamples = 25;  // a trajectory, in the paper
constexpr int kTrajectoriesInARun = 10;

double torque_phi(const GeneratorRecipe& recipe) {
  if (recipe.fit.kind == ResidualKind::mlp) return recipe.next_torque ? 1.0 : 0.0;
  return recipe.torque_phi;
}

}  // namespace

ResidualGenerator untrained_generator(const Robot& robot, const GeneratorRecipe& recipe) {
  ResidualGenerator generator;
  generator.kind = recipe.fit.kind;
  generator.target = recipe.fit.target;
  generator.shape = one_sample(robot.joints(), torque_phi(recipe));
  generator.uses_mean_torque = recipe.next_torque;
  generator.turns.assign(robot.joints(), 0);
  generator.chain = recipe.assumed.value_or(robot.chain);
  return generator;
}

std::vector<Log> healthy_trajectories(const Experiment& experiment, int count, double sigma, SeedUse use) {
  std::vector<Log> logs;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t own = seed_of(experiment.seed, use, i);
    logs.push_back(trajectory(experiment.robot, experiment.controller, kSamples, own));
    add_noise(logs.back(), experiment.ranges, sigma, own);
  }
  return logs;
}

std::vector<Log> healthy_runs(const Experiment& experiment, int trajectories, double sigma, SeedUse use) {
  const RunOfMoves run{.duration_s = kTrajectoriesInARun * kSamples * kSamplePeriod};
  std::vector<Log> logs;
  for (int i = 0; i * kTrajectoriesInARun < trajectories; ++i) {
    const std::uint64_t own = seed_of(experiment.seed, use, i);
    logs.push_back(run_of_moves(experiment.robot, experiment.controller, run, own));
    add_noise(logs.back(), experiment.ranges, sigma, own);
  }
  return logs;
}

ResidualGenerator train_generator(const Experiment& experiment, const GeneratorRecipe& recipe) {
  ResidualGenerator untrained = untrained_generator(experiment.robot, recipe);
  const double phi = untrained.shape.torque_phi;
  const auto draw = recipe.runs_of_moves ? healthy_runs : healthy_trajectories;
  std::vector<Log> logs = draw(experiment, recipe.trajectories + recipe.trajectories / 5, recipe.sigma,
                               SeedUse::generator_training);
  const int training_count =
      recipe.runs_of_moves ? recipe.trajectories / kTrajectoriesInARun : recipe.trajectories;
  const Transitions check = transitions_of({logs.begin() + training_count, logs.end()}, phi);
  logs.resize(training_count);
  ResidualOptions fit = recipe.fit;
  fit.seed = seed_of(experiment.seed, SeedUse::generator_training, ~0ull);
  ResidualGenerator fitted = fit_residual_generator(std::move(untrained), transitions_of(logs, phi), {}, fit);
  fitted.healthy = healthy_residuals(fitted, check);
  return fitted;
}

Eigen::VectorXd normalised_mse_by_output(const Eigen::MatrixXd& error, const HalfRanges& ranges) {
  return (ranges.state().cwiseInverse().asDiagonal() * error).array().square().rowwise().mean();
}

}  // namespace faultline
