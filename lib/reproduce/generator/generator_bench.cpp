// SPDX-License-Identifier: MIT
#include "lib/reproduce/generator/generator_bench.hpp"

namespace faultline {

GeneratorBench generator_bench(const Robot& robot, ControllerReading controller, const HalfRanges& ranges,
                               int trajectories, std::uint64_t seed) {
  GeneratorBench bench{robot, controller, seed, ranges, {}};
  for (int reading = 0; reading < 3; ++reading)
    bench.tests[reading] = healthy_trajectories(robot, controller, trajectories, kNoiseReadings[reading],
                                                ranges, seed, SeedUse::generator_test);
  bench.tests[static_cast<int>(GeneratorTest::clean_runs)] =
      healthy_runs(robot, controller, trajectories, 0.0, ranges, seed, SeedUse::generator_test);
  return bench;
}

GeneratorErrors errors_of(const ResidualGenerator& generator, const GeneratorBench& bench) {
  GeneratorErrors errors(2 * generator.joints(), kGeneratorTests);
  for (int test = 0; test < kGeneratorTests; ++test)
    errors.col(test) = normalised_mse_by_output(
        generator, transitions_of(bench.tests[test], generator.shape.torque_phi), bench.ranges);
  return errors;
}

GeneratorErrors persistence_errors(const GeneratorBench& bench) {
  GeneratorErrors errors(2 * bench.robot.joints(), kGeneratorTests);
  for (int test = 0; test < kGeneratorTests; ++test) {
    const Transitions transitions = transitions_of(bench.tests[test]);
    Eigen::MatrixXd change(errors.rows(), transitions.count());
    change << transitions.next_q - transitions.q, transitions.next_dq - transitions.dq;
    errors.col(test) = normalised_mse_by_output(change, bench.ranges);
  }
  return errors;
}

GeneratorErrors errors_of(const GeneratorRecipe& recipe, const GeneratorBench& bench) {
  return errors_of(train_generator(bench.robot, bench.controller, recipe, bench.ranges, bench.seed).generator,
                   bench);
}

}  // namespace faultline
