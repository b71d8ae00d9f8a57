// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "lib/core/progress.hpp"
#include "lib/reproduce/page/reproduction.hpp"
#include "lib/reproduce/page/result_table.hpp"
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

/// How much the study of residual generators trains and tests.
struct GeneratorScale {
  int test_trajectories = 200;
  int trajectories = 100;       ///< of the paper's training set
  int many_trajectories = 800;  ///< of the large one
  int epochs = 1500;            ///< of back-propagation
  int iterations = 20;          ///< of Levenberg-Marquardt
  int many_iterations = 20;     ///< the same on the large set, in the first experiment only
  int noisy_iterations = 7;     ///< the same on patterns with noise of 0.1, where more only fits the noise
  LearningLogs slow_logs{};
  LearningLogs fast_logs{.count = 1, .duration_s = 20.0, .sample_period_s = 0.001, .max_rows = 6000};
};
GeneratorScale quick_scale();

/// A bench with what identification made of its robot.
struct IdentifiedBench {
  GeneratorBench bench;
  Robot identified;                         ///< from logs at the paper's sample period
  std::optional<Robot> identified_at_1khz;  ///< empty where it was not wanted, or the torque is held longer
};

/// What an independent study measured of the same generator; NaN where it did not.
struct StudyFigures {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::array<double, kControllers> clean{kNone, kNone, kNone};  ///< of kControllerVariants
  double held_noise_01 = kNone;
  double held_noise_1 = kNone;
};

/// A residual generator of the comparison. `errors` is empty where it does not apply to a controller.
struct GeneratorCandidate {
  std::string name;
  std::string patterns;  ///< trained on, "-" for none
  StudyFigures study;
  std::function<std::optional<GeneratorErrors>(const IdentifiedBench&)> errors;
  bool first_seed_only = false;  ///< dear to train: measured in the first experiment only
};

/// On the robot without friction: the paper's generator, its variants and physics.
std::vector<GeneratorCandidate> paper_candidates(const GeneratorScale& scale);
/// On the robot with friction: what a wrong model costs and what identification and a network mend.
std::vector<GeneratorCandidate> friction_candidates(const GeneratorScale& scale);

// Names by which goals and texts find their rows.
inline constexpr const char* kBackPropagation = "MLP 9-49-6, back-propagation";
inline constexpr const char* kLevenbergMarquardt = "MLP 9-49-6, Levenberg-Marquardt";
inline constexpr const char* kTrainedWithNoise = "MLP 9-49-6, Levenberg-Marquardt, trained with noise 0.1";
inline constexpr const char* kPhysicsTrue = "physics, true parameters";
inline constexpr const char* kPhysicsIdentified = "physics, identified";
inline constexpr const char* kWrongAndMlp = "that wrong physics + MLP of 20 units";
inline constexpr const char* kHybrid = "hybrid: identified physics + MLP of 20 units";

/// Errors of every candidate, under every controller, in every experiment.
struct GeneratorMeasurements {
  std::vector<GeneratorCandidate> candidates;
  int seeds = 0;
  std::vector<std::optional<GeneratorErrors>> errors;  ///< candidate, then controller, then seed

  std::size_t index(int candidate, int controller, int seed) const;
  /// Mean over the outputs, or one of them; NaN for seeds without, nothing where the candidate does not
  /// apply.
  std::optional<Measured> mse(int candidate, int controller, GeneratorTest test) const;
  std::optional<Measured> mse(int candidate, int controller, GeneratorTest test, int output) const;
  /// Of the error in runs of moves; means over the seeds, NaN where the candidate does not apply.
  WorstSamples worst(int candidate, int controller) const;
  /// Number of the candidate of this name. Throws Error(internal) when there is none.
  int find(const std::string& name) const;
};

struct GeneratorComparison {
  Robot robot;
  std::vector<GeneratorCandidate> candidates;
  GeneratorScale scale;
  bool with_fast_logs = false;  ///< also identified from a log at 1 kHz
};

/// Identifies the robot under each controller and seed and measures all candidates on it.
GeneratorMeasurements measure_generators(const GeneratorComparison& comparison,
                                         const ReproduceOptions& options, const Progress& progress);

}  // namespace faultline
