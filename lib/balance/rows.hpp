// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/row_setting.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

/// Rows x joints.
using JointMask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

/// Torque balance of a log on a coarse grid (equation (1) of docs/how-it-works.md): the smoothed torque of
/// each row and joint, and what each parameter of the robot adds to it. Row k is the motion within the kernel
/// around time_s[k]; there is no row whose kernel leaves the log.
struct BalanceRows {
  Eigen::VectorXd time_s;
  Eigen::MatrixXd torque;       ///< rows x joints, N m or N
  Eigen::MatrixXd q, dq;        ///< rows x joints, smoothed; `dq` is that of the link, behind the gear spring
  Eigen::MatrixXd step_square;  ///< rows x joints: sum of (weight of the kernel * step of the torque)^2
  std::vector<Eigen::MatrixXd> column;  ///< by joint: rows x parameters (see ColumnLayout)
  std::vector<bool> lost;               ///< by row: its kernel crosses samples that the log lacks
  /// Balances that show nothing and have no weight (silent_balances()). Empty if there is none.
  JointMask silent{};

  int rows() const { return static_cast<int>(time_s.size()); }
  int joints() const { return static_cast<int>(torque.cols()); }
  bool is_silent(int row, int j) const { return silent.size() > 0 && silent(row, j); }
};

/// Returns the rows of one log. The columns of springs and load friction take inertia and carried torque from
/// `theta`; if it is empty, they are zero. Throws Error(input) when the log is shorter than the kernels.
BalanceRows balance_rows(const UniformLog& log, const RowSetting& setting, const RigidColumns& rigid,
                         const Eigen::VectorXd& theta);

/// Returns the columns of viscous and Coulomb friction of joint `j` (from 0), rows x 2: those that change
/// with its friction width and its spring.
Eigen::MatrixX2d friction_columns(const UniformLog& log, const RowSetting& setting, int j);

/// Returns the greatest distance of a sample from the middle of a row to which it contributes, s.
double reach_s(const RowSetting& setting);

/// Returns the time over which a change of one velocity shows in the fused velocity of other samples by more
/// than the share `share`, s; infinite if the logged velocity has no noise.
double velocity_reach_s(const RowSetting& setting, double share);

/// Returns the chain with the inertias of `theta`; its friction is not set.
Chain chain_of(const RigidColumns& rigid, const Eigen::VectorXd& theta);

/// Returns the dynamics by base parameter, with it 1 and all others 0; empty unless all axes are parallel.
std::vector<FastDynamics> unit_dynamics(const RigidColumns& rigid);

/// Returns the velocity of each sample (rows x joints): position differences at low frequencies, the logged
/// velocity at high ones.
Eigen::MatrixXd fused_velocity(const UniformLog& log, const RowSetting& setting);

}  // namespace faultline
