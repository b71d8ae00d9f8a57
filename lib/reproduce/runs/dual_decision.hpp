// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/classify/sample_classifier.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"
#include "lib/reproduce/runs/criterion_sweep.hpp"
#include "lib/reproduce/runs/detectors.hpp"

namespace faultline {

// The paper's second approach (figure 2): both networks, and a case-based decision where they disagree.

/// What one network has summed up of its log odds against fault-free.
struct NetworkSum {
  Eigen::VectorXd sum;  ///< of each fault, nats
  int output = 0;       ///< the fault with the largest
  double best = 0.0;    ///< that largest sum
  double last = 0.0;    ///< what the last sample added to it
};

/// A sample at which one of the networks suspects a fault: an episode before it is decided.
struct SuspectSample {
  double time_s = 0.0;
  int samples = 0;  ///< since both networks' sums were zero
  NetworkSum mlp, rbfn;

  double largest() const;
};

/// The samples at which a network's sum is at least `least` nats, in order of time.
std::vector<SuspectSample> suspect_samples(const SampleClassifier& classifier, const SampleOutputs& outputs,
                                           double sample_cap, double least);

std::vector<std::string> suspect_feature_names(int faults);
/// As case-based reasoning compares it. A network's opinion is its fault where its sum reaches `threshold`,
/// else `none`.
Episode episode_of(const SuspectSample& suspicion, const std::vector<FaultLabel>& classes, double threshold);

/// Cases of suspicions of known truth in these runs: of each faulty run the first few after its onset, and
/// false ones in between, at most `most_false` of all runs.
CaseBase cases_of_suspects(const SampleDetector& detector, std::span<const ExperimentRun> runs,
                           double sample_cap, double least, int most_false);

/// Decision at the level of the episode, for each threshold (nats, ascending): both networks sum up log odds,
/// a network whose sum reaches the threshold names its fault. Where both name the same one it stands;
/// where only one does, or they name two, similar cases settle it: a fault, or a false alarm. Alarms for each
/// threshold; after one, both sums have to return to zero before the next.
std::vector<Alarms> decide_suspects(const std::vector<SuspectSample>& suspicions,
                                    const std::vector<FaultLabel>& classes, const CaseBase& cases,
                                    std::span<const double> thresholds);

/// Cases of single samples with both networks' outputs: at most `most_of_class` of each class.
CaseBase cases_of_samples(const SampleDetector& detector, std::span<const ExperimentRun> runs,
                          int most_of_class);
/// Decision at each sample, the naive reading of figure 2: 1 for the class decided, classes x samples.
Eigen::MatrixXd decide_samples(const SampleOutputs& outputs, const std::vector<FaultLabel>& classes,
                               const CaseBase& cases);

}  // namespace faultline
