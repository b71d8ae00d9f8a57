// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/reproduce/runs/criterion_sweep.hpp"
#include "lib/reproduce/runs/network_sums.hpp"
#include "lib/reproduce/runs/sample_detector.hpp"

namespace faultline {

// The paper's second approach (figure 2): both networks, and a case-based decision where they disagree.

/// Cases of suspicions of known truth in these runs: of each faulty run the first few after its onset, and
/// false ones in between, at most `most_false` of all runs.
CaseBase cases_of_suspicions(const SampleDetector& detector, std::span<const ExperimentRun> runs,
                             double sample_cap, double least, int most_false);

/// Decision at the level of the episode, for each threshold (nats, ascending): both networks sum up log odds,
/// a network whose sum reaches the threshold names its fault. Where both name the same one it is believed;
/// where only one does, or they name two, similar cases settle it: a fault, or a false alarm. Alarms for each
/// threshold; after one, both sums have to return to zero before the next.
std::vector<Alarms> decide_suspicions(const std::vector<Suspicion>& suspicions,
                                      const std::vector<FaultLabel>& classes, const CaseBase& cases,
                                      std::span<const double> thresholds);

/// Cases of single samples with both networks' outputs: at most `most_of_class` of each class.
CaseBase cases_of_samples(const SampleDetector& detector, std::span<const ExperimentRun> runs,
                          int most_of_class);
/// Decision at each sample, the naive reading of figure 2: 1 for the class decided, classes x samples.
Eigen::MatrixXd decide_samples(const SampleOutputs& outputs, const std::vector<FaultLabel>& classes,
                               const CaseBase& cases);

}  // namespace faultline
