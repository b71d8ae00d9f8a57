// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/balance/row_setting.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

/// The torque balance of a log on a coarse grid (equation (1) of docs/how-it-works.md): the smoothed torque
/// of each row and joint, and what each parameter of the robot adds to it. Row k stands for the motion within
/// the kernel around time_s[k]; rows whose kernel leaves the log do not exist.
struct BalanceRows {
  Eigen::VectorXd time_s;
  Eigen::VectorXi sample;       ///< by row: the sample before its middle
  Eigen::MatrixXd torque;       ///< rows x joints, N m or N
  Eigen::MatrixXd q, dq;        ///< rows x joints, smoothed; `dq` is that of the link, behind the gear spring
  Eigen::MatrixXd step_square;  ///< rows x joints: sum of (weight of the kernel * step of the torque)^2
  std::vector<Eigen::MatrixXd> column;  ///< by joint: rows x parameters (see ColumnLayout)
  std::vector<bool> lost;               ///< by row: its kernel crosses samples that the log lacks

  int rows() const { return static_cast<int>(time_s.size()); }
  int joints() const { return static_cast<int>(torque.cols()); }
};

/// Rows of one log. `theta` are the parameters that the columns of springs need for the inertia matrix; while
/// it is empty, these columns are zero. Throws Error(input) when the log is shorter than the kernels.
BalanceRows balance_rows(const UniformLog& log, const RowSetting& setting, const RigidColumns& rigid,
                         const Eigen::VectorXd& theta);

/// The columns of viscous and Coulomb friction of joint `joint` (from 0) alone: what its width and its spring
/// change.
Eigen::MatrixX2d friction_columns(const UniformLog& log, const RowSetting& setting, int joint);

/// How far the samples that a row is made of lie from its middle at most, s.
double reach_s(const RowSetting& setting);

/// How far a sample's velocity shows in those of others with more than a share of it, s; without bound where
/// the logged velocity has no noise.
double velocity_reach_s(const RowSetting& setting, double share);

/// The chain that moves as `theta` says; its friction does not count.
Chain chain_of(const RigidColumns& rigid, const Eigen::VectorXd& theta);

/// The chain by base parameter, that one 1 and the others 0; none where the axes are not all parallel.
std::vector<FastDynamics> unit_dynamics(const RigidColumns& rigid);

/// Velocity of each sample (rows x joints): the positions' differences where these are more precise, the
/// logged velocity where that one is.
Eigen::MatrixXd fused_velocity(const UniformLog& log, const RowSetting& setting);

}  // namespace faultline
