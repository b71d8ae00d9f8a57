// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lib/reproduce/runs/run_condition.hpp"
#include "lib/reproduce/runs/sample_detector.hpp"

namespace faultline {

/// The runs of one controller and noise.
struct ConditionRuns {
  std::vector<ExperimentRun> training, tuning, test;
};

/// Networks over the residuals of single samples: MLP, RBFN, their average and the case-based decision, each
/// under the paper's criterion and, with `sum_log_odds` (networks that put out probabilities), under summed
/// log odds. `recipe` begins the detectors' names; of the recipe with `sum_log_odds` it is also counted how
/// often both networks agree.
void watch_with_networks(const SampleDetector& detector, const ConditionRuns& runs, const std::string& recipe,
                         bool sum_log_odds, ConditionResult& result);

}  // namespace faultline
