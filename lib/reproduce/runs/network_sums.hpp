// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lib/cases/case_base.hpp"
#include "lib/classify/sample_classifier.hpp"
#include "lib/reproduce/runs/alarm_score.hpp"

namespace faultline {

/// What one network has summed up of its log odds against fault-free.
struct NetworkSum {
  Eigen::VectorXd sum;  ///< of each fault, nats
  int output = 0;       ///< the fault with the largest
  double best = 0.0;    ///< that largest sum
  double last = 0.0;    ///< what the last sample added to it
};

/// A sample at which one of the networks suspects a fault: an episode before it is decided.
struct Suspicion {
  double time_s = 0.0;
  int samples = 0;  ///< since both networks' sums were zero
  NetworkSum mlp, rbfn;

  double largest() const;
};

/// The sums were not zero in between.
bool continues(const Suspicion& earlier, const Suspicion& later);

/// The samples at which a network's sum is at least `least` nats, in order of time.
std::vector<Suspicion> suspicions_of(const SampleClassifier& classifier, const SampleOutputs& outputs,
                                     double sample_cap, double least);

std::vector<std::string> suspicion_feature_names(int faults);
/// As case-based reasoning compares it. A network's opinion is its fault where its sum reaches `threshold`,
/// else `none`.
Episode episode_of(const Suspicion& suspicion, const std::vector<FaultLabel>& classes, double threshold);

}  // namespace faultline
