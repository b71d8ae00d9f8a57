// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_candidates.hpp"

#include <fmt/format.h>

namespace faultline {
namespace {

using Errors = std::optional<GeneratorErrors>;

constexpr int kPatternsInATrajectory = 25;

std::string patterns_of(int trajectories) { return fmt::format("{}", trajectories * kPatternsInATrajectory); }

bool is_held(const IdentifiedBench& on) { return on.bench.experiment.controller == ControllerVariant::held; }

/// The least that is known of the torque between samples: half way, unless it is held.
double middle(const IdentifiedBench& on) { return is_held(on) ? 0.0 : 0.5; }

GeneratorRecipe mlp_recipe(int trajectories, int iterations) {
  GeneratorRecipe recipe;
  recipe.trajectories = trajectories;
  recipe.fit.max_iterations = iterations;
  return recipe;
}

GeneratorCandidate mlp(std::string name, const GeneratorRecipe& recipe, const StudyFigures& study = {},
                       bool first_seed_only = false) {
  return {std::move(name), patterns_of(recipe.trajectories), study,
          [recipe](const IdentifiedBench& on) -> Errors { return errors_of(recipe, on.bench); },
          first_seed_only};
}

Errors physics_errors(const Chain& chain, double torque_phi, const IdentifiedBench& on) {
  GeneratorRecipe recipe{.torque_phi = torque_phi, .assumed = chain};
  recipe.fit.kind = ResidualKind::physics;
  return errors_of(untrained_generator(on.bench.experiment.robot, recipe), on.bench);
}

Errors hybrid_errors(const Chain& chain, double torque_phi, const GeneratorScale& scale,
                     const IdentifiedBench& on) {
  GeneratorRecipe recipe = mlp_recipe(scale.trajectories, scale.iterations);
  recipe.fit.kind = ResidualKind::hybrid;
  recipe.fit.hidden = {20};
  recipe.next_torque = !is_held(on);
  recipe.torque_phi = torque_phi;
  recipe.assumed = chain;
  return errors_of(recipe, on.bench);
}

/// Masses 5 % too large and no friction.
Chain wrong_chain() {
  Robot robot = bench_robot();
  set_masses_and_lengths(robot, {1.05, 0.84, 0.525}, {1.0, 0.8, 0.0});
  return robot.chain;
}

double identified_phi(const IdentifiedBench& on) { return on.identified.torque_phi.value_or(middle(on)); }

GeneratorCandidate persistence(const StudyFigures& study) {
  return {"x(t+dt) = x(t)", "-", study,
          [](const IdentifiedBench& on) -> Errors { return persistence_errors(on.bench); }};
}

GeneratorCandidate true_physics(const StudyFigures& study) {
  return {kPhysicsTrue, "-", study, [](const IdentifiedBench& on) {
            return physics_errors(on.bench.experiment.robot.chain, middle(on), on);
          }};
}

GeneratorCandidate identified_physics() {
  return {kPhysicsIdentified, "-", {}, [](const IdentifiedBench& on) {
            return physics_errors(on.identified.chain, identified_phi(on), on);
          }};
}

GeneratorCandidate hybrid(const GeneratorScale& scale, const StudyFigures& study) {
  return {kHybrid, patterns_of(scale.trajectories), study, [scale](const IdentifiedBench& on) {
            return hybrid_errors(on.identified.chain, identified_phi(on), scale, on);
          }};
}

}  // namespace

GeneratorScale full_scale() { return {}; }

GeneratorScale quick_scale() {
  GeneratorScale scale{.test_trajectories = 40,
                       .trajectories = 60,
                       .many_trajectories = 80,
                       .epochs = 200,
                       .iterations = 12,
                       .many_iterations = 8,
                       .noisy_iterations = 8};
  scale.slow_logs.max_rows = 80;
  scale.fast_logs.duration_s = 5.0;
  scale.fast_logs.max_rows = 800;
  return scale;
}

std::vector<GeneratorCandidate> paper_candidates(const GeneratorScale& scale) {
  const GeneratorRecipe standard = mlp_recipe(scale.trajectories, scale.iterations);
  GeneratorRecipe gradient = mlp_recipe(scale.trajectories, scale.epochs);
  gradient.fit.trainer = ResidualTrainer::back_propagation;
  GeneratorRecipe next_torque = standard;
  next_torque.next_torque = true;
  GeneratorRecipe runs = standard;
  runs.runs_of_moves = true;
  const GeneratorRecipe many = mlp_recipe(scale.many_trajectories, scale.many_iterations);
  std::vector<GeneratorCandidate> all{
      persistence({2.4e-3, 2.1e-3, 8.0e-3, 2.6e-3, 2.25e-2}),
      mlp(kBackPropagation, gradient, {4.0e-4, 4.1e-4, 1.2e-3, 6.0e-4, 2.0e-2}),
      mlp(kLevenbergMarquardt, standard, {3.9e-5, 1.5e-4, 9.9e-4, 2.4e-4, 2.1e-2}),
      mlp("MLP 12-49-6 (also tau(t+dt)), Levenberg-Marquardt", next_torque,
          {.held = 1.2e-5, .fast = 8.0e-6, .held_noise_01 = 2.2e-4, .held_noise_1 = 2.1e-2}),
      mlp("MLP 9-49-6, Levenberg-Marquardt, 8 times the patterns", many,
          {3.9e-6, 3.1e-5, 8.0e-4, 2.1e-4, 2.1e-2}, true),
      mlp("MLP 9-49-6, Levenberg-Marquardt, trained on runs of moves", runs)};
  GeneratorRecipe noisy = standard, noisier = mlp_recipe(scale.trajectories, scale.noisy_iterations);
  noisy.sigma = 0.01;
  noisier.sigma = 0.1;
  noisier.fit.weight_decay = 1e-4;  // less of it and more iterations fit the noise
  all.push_back(mlp("MLP 9-49-6, Levenberg-Marquardt, trained with noise 0.01", noisy));
  all.push_back(mlp(kTrainedWithNoise, noisier));
  all.push_back(true_physics({1.7e-15, 1.9e-6, 5.1e-3, 2.1e-4, 2.1e-2}));
  all.push_back(identified_physics());
  all.push_back(hybrid(scale, {}));
  return all;
}

std::vector<GeneratorCandidate> friction_candidates(const GeneratorScale& scale) {
  const std::string patterns = patterns_of(scale.trajectories);
  return {
      persistence({}),
      {"physics, masses 5 % off, no friction",
       "-",
       {.fast = 2.1e-2},
       [](const IdentifiedBench& on) { return physics_errors(wrong_chain(), middle(on), on); }},
      mlp(kLevenbergMarquardt, mlp_recipe(scale.trajectories, scale.iterations), {.fast = 2e-4}),
      {kWrongAndMlp,
       patterns,
       {.fast = 8.1e-5},
       [scale](const IdentifiedBench& on) { return hybrid_errors(wrong_chain(), middle(on), scale, on); }},
      identified_physics(),
      hybrid(scale, {.fast = 6e-7}),
      {"physics, identified from a log at 1 kHz",
       "-",
       {},
       [](const IdentifiedBench& on) -> Errors {
         if (!on.identified_at_1khz) return std::nullopt;
         return physics_errors(on.identified_at_1khz->chain, middle(on), on);
       }},
      {"hybrid: physics of a log at 1 kHz + MLP of 20 units",
       patterns,
       {},
       [scale](const IdentifiedBench& on) -> Errors {
         if (!on.identified_at_1khz) return std::nullopt;
         return hybrid_errors(on.identified_at_1khz->chain, middle(on), scale, on);
       }},
      true_physics({})};
}

}  // namespace faultline
