// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "lib/balance/one_step/one_step_model.hpp"
#include "lib/classify/sample_classifier.hpp"
#include "lib/learn/learn.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"
#include "lib/residual/residual_generator.hpp"

namespace faultline {

/// The paper's detector (figures 1 and 2) up to its criterion: the regenerated fault-free motion, and both
/// networks over the residuals of each sample.
struct SampleDetector {
  ResidualGenerator generator;
  SampleClassifier classifier;
};

/// The paper's recipe: velocity residuals, 900 patterns without noise of the 90 trajectories of its table 1,
/// the fault there from their start. A quarter as many trajectories again stop the MLP's training.
SampleDetector train_paper_detector(const ResidualGenerator& generator, const Experiment& experiment);
/// The best recipe: torque-space and ratio features, trained on samples of runs with faults at any time and
/// with the noise of use.
SampleDetector train_best_detector(const ResidualGenerator& generator, std::span<const ExperimentRun> runs,
                                   int patterns_per_class, std::uint64_t seed);

/// Both networks' outputs over a log.
SampleOutputs outputs_of(const SampleDetector& detector, const Log& log);

/// What this project's `learn` is given: three healthy logs with moves as in the protocol, and of the robot
/// its axes, whether the torque is held, and the length of link 1.
struct HealthyLogs {
  std::vector<Log> logs;
  Robot robot;
};
HealthyLogs healthy_logs(const Experiment& experiment, double duration_s, double sigma);

/// Learns on one thread. `quick`: from few simulated faults of three kinds and with a coarse residual
/// network.
Learned learn_product(const HealthyLogs& healthy, bool quick, std::uint64_t seed);
Identification identify_robot(const HealthyLogs& healthy);
/// One-step predictions of the true robot, with the noise of the readings that these logs show.
OneStepModel known_steps(const Robot& robot, const HealthyLogs& healthy);

/// `diagnose` on one run: when the regression raised alarms, and what each of those who name them says.
struct ProductAlarms {
  Alarms mlp;    ///< named by the MLP alone
  Alarms rbfn;   ///< by the RBFN alone
  Alarms cases;  ///< as diagnosed: both networks, and cases
};
ProductAlarms product_alarms(const Learned& learned, const Log& log);

}  // namespace faultline
