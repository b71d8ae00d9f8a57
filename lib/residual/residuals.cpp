// SPDX-License-Identifier: MIT
#include "lib/residual/residuals.hpp"

#include "lib/robot/fast_dynamics.hpp"

namespace faultline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

MatrixXd torque_space(const Chain& chain, const Transitions& transitions, const MatrixXd& velocity) {
  const FastDynamics robot(chain);
  JointMatrix inertia;
  JointVector bias;
  MatrixXd torque(velocity.rows(), velocity.cols());
  for (Index i = 0; i < velocity.cols(); ++i) {
    robot.inertia_and_bias(transitions.q.col(i), transitions.dq.col(i), inertia, bias);
    const JointVector rate = velocity.col(i) / transitions.duration[i];
    torque.col(i) = inertia * rate;
  }
  return torque;
}

}  // namespace

MatrixXd ratio_to_torque(const MatrixXd& torque, const MatrixXd& tau, const Eigen::VectorXd& torque_rms) {
  const Eigen::ArrayXd eps2 = 9.0 * torque_rms.array().square();
  return (torque.array() * tau.array() / (tau.array().square().colwise() + eps2)).matrix();
}

Transitions log_transitions(const ResidualGenerator& generator, const Log& segment, ResidualState& state) {
  TransitionShape shape = generator.shape;
  shape.derive_velocity = shape.derive_velocity || segment.dq.empty();
  return collect_transitions(segment, shape, state);
}

Residuals residuals_of(const ResidualGenerator& generator, const Transitions& transitions) {
  const Index n = generator.joints();
  const HealthyResiduals& healthy = generator.healthy;
  const MatrixXd difference =
      measured_change(generator, transitions) - predicted_change(generator, transitions);
  Residuals out;
  out.row = transitions.row;
  out.time = transitions.time;
  out.torque = torque_space(generator.chain, transitions, difference.bottomRows(n));
  out.tau = transitions.mean_tau;
  out.position = healthy.position_rms.cwiseInverse().asDiagonal() * difference.topRows(n);
  out.velocity = healthy.velocity_rms.cwiseInverse().asDiagonal() * difference.bottomRows(n);
  out.ratio = ratio_to_torque(out.torque, out.tau, healthy.torque_rms);
  return out;
}

Residuals compute_residuals(const ResidualGenerator& generator, const Log& segment, ResidualState& state) {
  if (generator.joints() == 0 || segment.tau.empty()) return {};
  return residuals_of(generator, log_transitions(generator, segment, state));
}

}  // namespace faultline
