// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "lib/reproduce/protocol/motion_generator.hpp"
#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/robot/robot.hpp"

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

/// Where an error lies: in the worst samples, as many as hold the start of a move, or in the others.
struct WorstSamples {
  double share_of_error = std::numeric_limits<double>::quiet_NaN();  ///< of the squares
  double mse_of_others = std::numeric_limits<double>::quiet_NaN();   ///< normalised, over all outputs
};
/// Of an error given as 2 joints x samples; NaN when it is not finite.
WorstSamples worst_samples(const Eigen::MatrixXd& error, const HalfRanges& ranges, double share_of_samples);

struct GeneratorErrors {
  Eigen::MatrixXd mse;  ///< normalised, an output a row (q1..qn, dq1..dqn), a GeneratorTest a column
  WorstSamples worst;   ///< of clean_runs; NaN when nothing was predicted
};
GeneratorErrors errors_of(const ResidualGenerator& generator, const GeneratorBench& bench);
/// Of predicting that nothing changes.
GeneratorErrors persistence_errors(const GeneratorBench& bench);

/// Healthy runs of moves that a robot is identified from.
struct LearningLogs {
  int count = 3;
  double duration_s = 60.0;
  double sample_period_s = kSamplePeriod;
  double sigma = 0.0;  ///< noise in half ranges
  int max_rows = 600;  ///< that shooting uses; identification is dearer than training a network here
};

/// What a user knows of the bench robot: its axes, the length of its first link, and whether the torque is
/// held between samples.
Robot robot_as_known(TorqueTiming timing);

/// That robot identified from healthy logs of the true one alone, friction and torque timing with it.
Robot identified_robot(const Experiment& experiment, const LearningLogs& logs);

}  // namespace faultline
