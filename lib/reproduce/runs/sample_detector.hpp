// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "lib/classify/sample_classifier.hpp"
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

}  // namespace faultline
