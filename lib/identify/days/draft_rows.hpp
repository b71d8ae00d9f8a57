// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/uniform_log.hpp"

namespace faultline {

/// Prior standard deviation of the delay of one joint's torque beyond the lag of all torques, samples.
inline constexpr double kDelayStd = 0.3;

/// Returns the model, a BalanceModel or OneStepModel, with range, torque rms and repeated positions of the
/// healthy logs; the top speed is 0.
template <typename Model>
Model with_motion_of(const std::vector<UniformLog>& logs, Model m) {
  // Bounds of the share of repeated positions, whose logarithm is the price of a stuck encoder.
  constexpr double kFewestRepeats = 1e-3, kMostRepeats = 0.999;
  const int n = logs.front().joints();
  m.q_low = Eigen::VectorXd::Constant(n, 1e300);
  m.q_high = -m.q_low;
  m.top_speed = m.torque_rms = m.repeat_share = Eigen::VectorXd::Zero(n);
  m.longest_repeat = Eigen::VectorXi::Zero(n);
  double rows = 0.0;
  for (const UniformLog& log : logs) {
    m.q_low = m.q_low.cwiseMin(log.q.colwise().minCoeff().transpose());
    m.q_high = m.q_high.cwiseMax(log.q.colwise().maxCoeff().transpose());
    m.torque_rms += log.tau.cwiseAbs2().colwise().sum().transpose();
    rows += log.rows();
    const RepeatedPositions repeats = repeated_positions(log);
    m.longest_repeat = m.longest_repeat.cwiseMax(repeats.longest);
    m.repeat_share += repeats.share / static_cast<double>(logs.size());
  }
  m.repeat_share = m.repeat_share.cwiseMax(kFewestRepeats).cwiseMin(kMostRepeats);
  m.torque_rms = (m.torque_rms / rows).cwiseSqrt();
  return m;
}

/// Returns by joint whether a log shows that its velocity was computed from its position (is_derived()).
/// `logs` have the samples as recorded, not means.
std::vector<bool> derived_velocities(const std::vector<UniformLog>& logs);

/// Returns the row setting that follows from the logs alone: rate, decimation, and the weight of the logged
/// velocity by its noise.
RowSetting draft_setting(const std::vector<UniformLog>& logs, double kernel_s, double row_s);

/// Returns the static friction of each joint that it holds at rest (BalanceModel::stiction), by a rigid robot
/// fitted to the joints in motion: 0 if its residual is not much larger at rest than in motion. `model` has
/// rigid columns, setting and top speeds.
Eigen::VectorXd static_friction(const std::vector<UniformLog>& logs, const BalanceModel& model);

/// Chooses the lag of all torques, then the friction width of each joint, that minimise the residual of a
/// rigid robot. Silent balances do not count. `model` has rigid columns, setting, top speeds, static friction
/// and limits of the drives.
RowSetting with_chosen_lag_and_widths(const std::vector<UniformLog>& logs, const BalanceModel& model);

/// Least squares without noise model, each joint divided by its residual `scale`; columns not `used` get 0.
Eigen::VectorXd plain_fit(const std::vector<BalanceRows>& rows, const ColumnLayout& layout,
                          const std::vector<bool>& used, const Eigen::VectorXd& scale);

/// Returns the columns of a robot without springs, ripples, load friction and coupled drives. The offset of a
/// joint is free unless the joint carries weight.
std::vector<bool> rigid_columns_used(const RigidColumns& rigid, const ColumnLayout& layout);

}  // namespace faultline
