// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_measurements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "lib/core/error.hpp"
#include "lib/core/parallel.hpp"
#include "lib/identify/identify.hpp"
#include "lib/log/log_source.hpp"
#include "lib/robot/robot.hpp"

namespace faultline {
namespace {

using Errors = std::optional<GeneratorErrors>;

constexpr int kPatternsInATrajectory = 25;
constexpr double kNone = StudyFigures::kNone;

StudyFigures fast_only(double clean) { return {.clean = {kNone, clean, kNone}}; }

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
          [recipe](const IdentifiedBench& on) -> Errors {
            return errors_of(train_generator(on.bench.experiment, recipe), on.bench);
          },
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
  recipe.fit.hidden = 20;
  recipe.next_torque = !is_held(on);
  recipe.torque_phi = torque_phi;
  recipe.assumed = chain;
  return errors_of(train_generator(on.bench.experiment, recipe), on.bench);
}

/// Masses 5 % too large and no friction.
Chain wrong_chain() {
  Robot robot = bench_robot();
  robot = with_masses_and_lengths(std::move(robot), {1.05, 0.84, 0.525}, {1.0, 0.8, 0.0});
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

template <class Pick>
std::optional<Measured> by_seed(const GeneratorMeasurements& all, int candidate, int controller,
                                const Pick& pick) {
  Measured measured;
  for (int seed = 0; seed < all.seeds; ++seed) {
    const auto& errors = all.errors[all.index(candidate, controller, seed)];
    measured.by_seed.push_back(errors ? pick(*errors) : std::numeric_limits<double>::quiet_NaN());
  }
  if (std::isnan(measured.mean())) return std::nullopt;
  return measured;
}

IdentifiedBench identified_bench(const Experiment& experiment, const GeneratorComparison& comparison) {
  const GeneratorScale& scale = comparison.scale;
  IdentifiedBench out{generator_bench(experiment, scale.test_trajectories),
                      identified_robot(experiment, scale.slow_logs),
                      {}};
  if (comparison.with_fast_logs && experiment.controller != ControllerVariant::held)
    out.identified_at_1khz = identified_robot(experiment, scale.fast_logs);
  return out;
}

}  // namespace

GeneratorScale quick_scale() {
  GeneratorScale scale{.test_trajectories = 40,
                       .trajectories = 60,
                       .many_trajectories = 80,
                       .epochs = 200,
                       .iterations = 8,
                       .many_iterations = 6,
                       .noisy_iterations = 4};
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
      persistence({{2.4e-3, 2.1e-3, 8.0e-3}, 2.6e-3, 2.25e-2}),
      mlp(kBackPropagation, gradient, {{4.0e-4, 4.1e-4, 1.2e-3}, 6.0e-4, 2.0e-2}),
      mlp(kLevenbergMarquardt, standard, {{3.9e-5, 1.5e-4, 9.9e-4}, 2.4e-4, 2.1e-2}),
      mlp("MLP 12-49-6 (also tau(t+dt)), Levenberg-Marquardt", next_torque,
          {{1.2e-5, 8.0e-6, kNone}, 2.2e-4, 2.1e-2}),
      mlp("MLP 9-49-6, Levenberg-Marquardt, 8 times the patterns", many,
          {{3.9e-6, 3.1e-5, 8.0e-4}, 2.1e-4, 2.1e-2}, true),
      mlp("MLP 9-49-6, Levenberg-Marquardt, trained on runs of moves", runs)};
  GeneratorRecipe noisy = standard, noisier = mlp_recipe(scale.trajectories, scale.noisy_iterations);
  noisy.sigma = 0.01;
  noisier.sigma = 0.1;
  noisier.fit.weight_decay = 1e-4;  // less of it and more iterations fit the noise
  all.push_back(mlp("MLP 9-49-6, Levenberg-Marquardt, trained with noise 0.01", noisy));
  all.push_back(mlp(kTrainedWithNoise, noisier));
  all.push_back(true_physics({{1.7e-15, 1.9e-6, 5.1e-3}, 2.1e-4, 2.1e-2}));
  all.push_back(identified_physics());
  all.push_back(hybrid(scale, {}));
  return all;
}

std::vector<GeneratorCandidate> friction_candidates(const GeneratorScale& scale) {
  const std::string patterns = patterns_of(scale.trajectories);
  return {
      persistence({}),
      {"physics, masses 5 % off, no friction", "-", fast_only(2.1e-2),
       [](const IdentifiedBench& on) { return physics_errors(wrong_chain(), middle(on), on); }},
      mlp(kLevenbergMarquardt, mlp_recipe(scale.trajectories, scale.iterations), fast_only(2e-4)),
      {kWrongAndMlp, patterns, fast_only(8.1e-5),
       [scale](const IdentifiedBench& on) { return hybrid_errors(wrong_chain(), middle(on), scale, on); }},
      identified_physics(),
      hybrid(scale, fast_only(6e-7)),
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

std::size_t GeneratorMeasurements::index(int candidate, int controller, int seed) const {
  return static_cast<std::size_t>((candidate * kControllers + controller) * seeds + seed);
}

std::optional<Measured> GeneratorMeasurements::mse(int candidate, int controller, GeneratorTest test) const {
  return by_seed(*this, candidate, controller,
                 [&](const GeneratorErrors& found) { return found.mse.col(static_cast<int>(test)).mean(); });
}

std::optional<Measured> GeneratorMeasurements::mse(int candidate, int controller, GeneratorTest test,
                                                   int output) const {
  return by_seed(*this, candidate, controller,
                 [&](const GeneratorErrors& found) { return found.mse(output, static_cast<int>(test)); });
}

WorstSamples GeneratorMeasurements::worst(int candidate, int controller) const {
  const auto mean = [&](double WorstSamples::*figure) {
    const auto figures = by_seed(*this, candidate, controller,
                                 [&](const GeneratorErrors& found) { return found.worst.*figure; });
    return figures.value_or(Measured{}).mean();
  };
  return {mean(&WorstSamples::share_of_error), mean(&WorstSamples::mse_of_others)};
}

int GeneratorMeasurements::find(const std::string& name) const {
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (candidates[i].name == name) return static_cast<int>(i);
  throw Error(ErrorCode::internal, "GeneratorMeasurements", "no candidate is called " + name);
}

GeneratorMeasurements measure_generators(const GeneratorComparison& comparison,
                                         const ReproduceOptions& options, const Progress& progress) {
  GeneratorMeasurements out{comparison.candidates, options.seeds, {}};
  const int benches = kControllers * options.seeds, count = static_cast<int>(out.candidates.size());
  out.errors.resize(static_cast<std::size_t>(benches) * out.candidates.size());
  std::vector<HalfRanges> ranges;
  for (const ControllerVariant controller : kControllerVariants)
    ranges.push_back(half_ranges(comparison.robot, controller));

  const std::string what = "residual generators";
  const double share = 1.0 / (count + 1);  // of the time, for the identification
  const Progress identifying = part_of(progress, 0.0, share), measuring = part_of(progress, share, 1.0);
  std::vector<IdentifiedBench> identified(benches);
  parallel_steps(what, benches, options.threads, identifying, [&](int i) {
    const int controller = i / options.seeds;
    identified[i] = identified_bench({comparison.robot, kControllerVariants[controller], ranges[controller],
                                      options.seed + i % options.seeds},
                                     comparison);
  });
  parallel_steps(what, benches * count, options.threads, measuring, [&](int i) {
    const GeneratorCandidate& candidate = out.candidates[i / benches];
    if (!candidate.first_seed_only || i % options.seeds == 0)
      out.errors[i] = candidate.errors(identified[i % benches]);
  });
  return out;
}

GeneratorBench generator_bench(const Experiment& experiment, int trajectories) {
  GeneratorBench bench{experiment, {}};
  for (int reading = 0; reading < 3; ++reading)
    bench.tests[reading] =
        healthy_trajectories(experiment, trajectories, kNoiseVariants[reading], SeedUse::generator_test);
  bench.tests[static_cast<int>(GeneratorTest::clean_runs)] =
      healthy_runs(experiment, trajectories, 0.0, SeedUse::generator_test);
  return bench;
}

WorstSamples worst_samples(const Eigen::MatrixXd& error, const HalfRanges& ranges, double share_of_samples) {
  Eigen::VectorXd squares =
      (ranges.state().cwiseInverse().asDiagonal() * error).array().square().colwise().mean();
  if (!squares.allFinite() || squares.size() == 0) return {};
  std::sort(squares.begin(), squares.end(), std::greater<>());
  const auto worst = static_cast<Eigen::Index>(share_of_samples * static_cast<double>(squares.size()));
  return {squares.head(worst).sum() / squares.sum(), squares.tail(squares.size() - worst).mean()};
}

GeneratorErrors errors_of(const ResidualGenerator& generator, const GeneratorBench& bench) {
  const HalfRanges& ranges = bench.experiment.ranges;
  GeneratorErrors errors{Eigen::MatrixXd(2 * generator.joints(), kGeneratorTests), {}};
  for (int test = 0; test < kGeneratorTests; ++test) {
    const Transitions transitions = transitions_of(bench.tests[test], generator.shape.torque_phi);
    const Eigen::MatrixXd error =
        measured_change(generator, transitions) - predicted_change(generator, transitions);
    errors.mse.col(test) = normalised_mse_by_output(error, ranges);
    if (test == static_cast<int>(GeneratorTest::clean_runs))
      errors.worst = worst_samples(error, ranges, share_with_a_start());
  }
  return errors;
}

GeneratorErrors persistence_errors(const GeneratorBench& bench) {
  GeneratorErrors errors{Eigen::MatrixXd(2 * bench.experiment.robot.joints(), kGeneratorTests), {}};
  for (int test = 0; test < kGeneratorTests; ++test) {
    const Transitions transitions = transitions_of(bench.tests[test]);
    Eigen::MatrixXd change(errors.mse.rows(), transitions.count());
    change << transitions.next_q - transitions.q, transitions.next_dq - transitions.dq;
    errors.mse.col(test) = normalised_mse_by_output(change, bench.experiment.ranges);
  }
  return errors;
}

Robot robot_as_known(TorqueTiming timing) {
  Robot robot = preset_robot("RRP");
  robot.name = "bench as known";
  robot.known["l1"] = {bench_robot().chain.length[0], 0.0};
  set_parameter(robot, "l1", robot.known["l1"].value);
  robot.log.torque_between_samples = timing;
  return robot;
}

Robot identified_robot(const Experiment& experiment, const LearningLogs& logs) {
  const RunOfMoves run{.duration_s = logs.duration_s, .sample_period_s = logs.sample_period_s};
  std::vector<std::unique_ptr<MemorySource>> sources;
  std::vector<LogSource*> healthy;
  for (int i = 0; i < logs.count; ++i) {
    const std::uint64_t own = seed_of(experiment.seed, SeedUse::learning_logs, i);
    Log log = run_of_moves(experiment.robot, experiment.controller, run, own);
    add_noise(log, experiment.ranges, logs.sigma, own);
    sources.push_back(std::make_unique<MemorySource>(std::move(log)));
    healthy.push_back(sources.back().get());
  }
  const bool is_held =
      experiment.controller == ControllerVariant::held || logs.sample_period_s < kSamplePeriod;
  const Robot known = robot_as_known(is_held ? TorqueTiming::held : TorqueTiming::unknown);
  return identify(healthy, known, {.max_rows = logs.max_rows, .max_iterations = 10, .threads = 1}).robot;
}

}  // namespace faultline
