// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_bench.hpp"

namespace faultline {

GeneratorBench generator_bench(const Experiment& experiment, int trajectories) {
  GeneratorBench bench{experiment, {}};
  for (int reading = 0; reading < 3; ++reading)
    bench.tests[reading] =
        healthy_trajectories(experiment, trajectories, kNoiseReadings[reading], SeedUse::generator_test);
  bench.tests[static_cast<int>(GeneratorTest::clean_runs)] =
      healthy_runs(experiment, trajectories, 0.0, SeedUse::generator_test);
  return bench;
}

GeneratorErrors errors_of(const ResidualGenerator& generator, const GeneratorBench& bench) {
  GeneratorErrors errors(2 * generator.joints(), kGeneratorTests);
  for (int test = 0; test < kGeneratorTests; ++test)
    errors.col(test) = normalised_mse_by_output(
        generator, transitions_of(bench.tests[test], generator.shape.torque_phi), bench.experiment.ranges);
  return errors;
}

GeneratorErrors persistence_errors(const GeneratorBench& bench) {
  GeneratorErrors errors(2 * bench.experiment.robot.joints(), kGeneratorTests);
  for (int test = 0; test < kGeneratorTests; ++test) {
    const Transitions transitions = transitions_of(bench.tests[test]);
    Eigen::MatrixXd change(errors.rows(), transitions.count());
    change << transitions.next_q - transitions.q, transitions.next_dq - transitions.dq;
    errors.col(test) = normalised_mse_by_output(change, bench.experiment.ranges);
  }
  return errors;
}

GeneratorErrors errors_of(const GeneratorRecipe& recipe, const GeneratorBench& bench) {
  return errors_of(train_generator(bench.experiment, recipe).generator, bench);
}

}  // namespace faultline
