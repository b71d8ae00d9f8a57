// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "lib/reproduce/protocol/protocol.hpp"
#include "lib/residual/physics_step.hpp"
#include "lib/simulate/controller.hpp"

namespace faultline {

/// Outputs as a linear function of the inputs and a Gaussian rest whose covariance is that of the known
/// patterns with the nearest inputs.
struct LocalGaussian {
  Eigen::MatrixXd trend;       ///< outputs x inputs
  Eigen::MatrixXd inputs;      ///< inputs x known patterns, divided by `scale`
  Eigen::MatrixXd rest;        ///< outputs x known patterns
  Eigen::VectorXd scale;       ///< rms of each input
  Eigen::MatrixXd covariance;  ///< of the rest, over all of them
};

/// Needs at least one pattern a column.
LocalGaussian fit_local_gaussian(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& outputs);
Eigen::VectorXd mean_at(const LocalGaussian& gaussian, const Eigen::VectorXd& input);
Eigen::MatrixXd covariance_at(const LocalGaussian& gaussian, const Eigen::VectorXd& input);

/// What the torque is taken to do between two samples.
enum class TorqueBetween {
  controlled,  ///< what the controller makes of it: constant (held), following the state at the set-point
               ///< that the first torque implies (pd), or keeping the acceleration it asks for (fast)
  linear,      ///< moves straight to the torque of the next sample
};

/// Predicts one sample of the bench robot, healthy or with a joint that swings freely: its own equations and
/// its controller's, with nothing learned.
class SampleModel {
 public:
  SampleModel(const Robot& robot, ControllerVariant controller, TorqueBetween between);

  /// The state a sample later. `output` is the class (table_1_class); `next_tau` matters for linear only.
  JointState next(const JointState& now, const JointVector& tau, const JointVector& next_tau,
                  int output) const;

  const FastDynamics& dynamics() const { return dynamics_; }

 private:
  JointVector set_point(const JointState& now, const JointVector& tau) const;

  FastDynamics dynamics_;
  ControllerVariant reading_;
  TorqueBetween between_;
  Controller controller_;
};

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
