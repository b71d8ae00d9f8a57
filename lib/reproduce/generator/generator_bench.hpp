// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "lib/reproduce/protocol/motion_generator.hpp"

namespace faultline {

/// What a residual generator is tested on in one experiment.
enum class GeneratorTest {
  clean,       ///< the paper's first set: 200 trajectories of 25 samples
  noise_01,    ///< the paper's second, read as 0.01 of half range
  noise_1,     ///< the same read as 0.1 of half range
  clean_runs,  ///< as many patterns of moves and rests one after the other
};
inline constexpr int kGeneratorTests = 4;

struct GeneratorBench {
  Experiment experiment;
  std::array<std::vector<Log>, kGeneratorTests> tests;
};
GeneratorBench generator_bench(const Experiment& experiment, int trajectories);

/// Normalised MSE, an output a row (q1..qn, dq1..dqn), a GeneratorTest a column.
using GeneratorErrors = Eigen::MatrixXd;
GeneratorErrors errors_of(const ResidualGenerator& generator, const GeneratorBench& bench);
/// Of predicting that nothing changes.
GeneratorErrors persistence_errors(const GeneratorBench& bench);
/// Of the generator trained as the recipe says in this bench's experiment.
GeneratorErrors errors_of(const GeneratorRecipe& recipe, const GeneratorBench& bench);

}  // namespace faultline
