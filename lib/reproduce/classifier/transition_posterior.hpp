// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "lib/reproduce/classifier/fault_trajectories.hpp"
#include "lib/reproduce/classifier/local_gaussian.hpp"
#include "lib/reproduce/classifier/sample_model.hpp"
#include "lib/reproduce/protocol/protocol.hpp"

namespace faultline {

/// The true models of one sample with what they leave over, of each class.
struct TransitionModel {
  SampleModel sample;
  /// What the torque does between the samples that the model does not know, of each class: M(q) e / dt^2
  /// (upper half) and M(q) de / dt (lower half), with e and de the errors of the predicted q and dq, N m or
  /// N; given (1, dq, tau, ddq), the last by the model at the sample's start.
  std::array<LocalGaussian, kFaultClasses> between;
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
