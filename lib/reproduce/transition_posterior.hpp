// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "lib/reproduce/fault_trajectories.hpp"
#include "lib/reproduce/protocol.hpp"
#include "lib/reproduce/sample_model.hpp"

namespace faultline {

/// The true models of one sample with what they leave over, of each class.
struct TransitionModel {
  SampleModel sample;
  /// Mean and covariance, over known patterns of each class, of M(q) e / dt^2 (upper half) and M(q) de / dt
  /// (lower half), with e and de the errors of the foretold q and dq: what the torque did between the samples
  /// and the model does not know. N m or N.
  std::array<Eigen::VectorXd, kFaultClasses> mean;
  std::array<Eigen::MatrixXd, kFaultClasses> covariance;
};

/// Learned from patterns without noise.
TransitionModel learn_transition_model(SampleModel sample, const FaultPatterns& patterns);

/// Probability of each class, given one pattern alone (q, dq, tau, the later q and dq), for patterns measured
/// with Gaussian noise of `sigma` half ranges at both ends, with the classes in the shares of table 1;
/// classes x patterns. The noise of the earlier end goes through each class's model, made linear at what was
/// measured.
Eigen::MatrixXd transition_posterior(const TransitionModel& model, const Transitions& transitions,
                                     const HalfRanges& ranges, double sigma);

/// Mean squared error of that posterior against 0 and 1: no classifier of single patterns can have less, as
/// far as the model is the truth.
double posterior_error(const TransitionModel& model, const FaultPatterns& patterns, const HalfRanges& ranges,
                       double sigma);

}  // namespace faultline
