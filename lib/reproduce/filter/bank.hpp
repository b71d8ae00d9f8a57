// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/reproduce/filter/follower.hpp"

namespace faultline {

/// One hypothesis from one onset on: its filter and its log likelihood ratio against the healthy filter.
struct RunningHypothesis {
  int hypothesis = 0;      ///< index into the bank
  std::int64_t onset = 0;  ///< the fault begins within the step into this sample (index into the history)
  double onset_s = 0.0;    ///< middle of that step
  double log_likelihood_ratio = 0.0;
  GaussianState state;
};

/// Runs hypotheses over samples that the healthy filter has followed.
class Bank {
 public:
  Bank(const MotionModel& model, const FaultDynamics& dynamics, const std::vector<Hypothesis>& hypotheses);

  /// A filter that starts from the healthy state before `onset` (>= 1), advanced by that one sample.
  RunningHypothesis start(int hypothesis, std::int64_t onset, const FollowedSample& before,
                          const FollowedSample& at) const;
  /// Advances a filter by one sample.
  void advance(RunningHypothesis& running, const FollowedSample& before, const FollowedSample& at) const;

 private:
  void observe(RunningHypothesis& running, const FollowedSample& at) const;

  const MotionModel& model_;
  const FaultDynamics& dynamics_;
  const std::vector<Hypothesis>& hypotheses_;
};

}  // namespace faultline
