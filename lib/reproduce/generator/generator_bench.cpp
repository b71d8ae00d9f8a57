// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_bench.hpp"

#include <algorithm>
#include <functional>

namespace faultline {

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
  Eigen::VectorXd half(error.rows());
  half << ranges.q, ranges.dq;
  Eigen::VectorXd squares = (half.cwiseInverse().asDiagonal() * error).array().square().colwise().mean();
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

GeneratorErrors errors_of(const GeneratorRecipe& recipe, const GeneratorBench& bench) {
  return errors_of(train_generator(bench.experiment, recipe).generator, bench);
}

}  // namespace faultline
