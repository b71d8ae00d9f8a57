// SPDX-License-Identifier: MIT
#include "lib/residual/residuals.hpp"

#include <cmath>

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

void ResidualSummary::add(const Residuals& residuals) {
  sums_.resize(residuals.joints());
  for (int i = 0; i < residuals.count(); ++i) {
    const double time = residuals.time[i];
    if (time < from_s_ || time > to_s_) continue;
    for (int j = 0; j < residuals.joints(); ++j) {
      const double velocity = residuals.velocity(j, i), position = residuals.position(j, i);
      if (!std::isfinite(velocity) || !std::isfinite(position)) continue;
      Sums& sums = sums_[j];
      if (++sums.count == 1 || std::fabs(velocity) > sums.velocity_peak) {
        sums.velocity_peak = std::fabs(velocity);
        sums.velocity_peak_s = time;
      }
      sums.velocity2 += velocity * velocity;
      sums.position2 += position * position;
    }
  }
}

std::vector<JointResidual> ResidualSummary::joints() const {
  std::vector<JointResidual> out;
  for (const Sums& sums : sums_) {
    JointResidual joint;
    joint.joint = Joint::at(static_cast<int>(out.size()));
    if (sums.count > 0) {
      const double count = static_cast<double>(sums.count);
      joint.velocity_rms = std::sqrt(sums.velocity2 / count);
      joint.velocity_peak = sums.velocity_peak;
      joint.velocity_peak_s = sums.velocity_peak_s;
      joint.position_rms = std::sqrt(sums.position2 / count);
    }
    out.push_back(joint);
  }
  return out;
}

}  // namespace faultline
