// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/row_frame.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

/// Residual torque in the rows of a log, and in those of logs that differ from it in the measurements of one
/// joint: torque - column * theta of BalanceRows except for the spring columns, computed without the columns.
class MeasuredResidual {
 public:
  /// Throws Error(input) when the log is shorter than the kernels.
  MeasuredResidual(const UniformLog& log, RowSetting setting, const RigidColumns& rigid,
                   Eigen::VectorXd theta);

  /// Returns the residual of the log with other measurements of joint `j` (from 0): rows from `first_row`
  /// on x joints, N m or N.
  Eigen::MatrixXd of(const MeasuredMotion& moved, int j, int first_row = 0) const;

 private:
  /// Returns the torque of joint `j` minus its friction, but that by load and that of coupled drives,
  /// offset, delay and ripple, by interval.
  Eigen::VectorXd drive(int j, const Eigen::VectorXd& speed, const Eigen::VectorXd& q) const;

  /// Returns the torque that the gears carry for the bodies, by interval from `from` on, with another motion
  /// of joint `j`: intervals x joints.
  Eigen::MatrixXd carried(const Eigen::VectorXd& q_of_joint, const Eigen::VectorXd& velocity, int j,
                          int from) const;
  /// Returns the torque of the coupled drives, by interval, with another motion of joint `j`: intervals x
  /// joints.
  Eigen::MatrixXd of_drives(const Eigen::VectorXd& velocity, const Eigen::VectorXd& speed, int j) const;

  RowSetting setting_;
  ColumnLayout layout_;
  Eigen::VectorXd theta_;
  RowFrame frame_;
  Eigen::MatrixXd q_;  ///< joints x samples, of the log
  FastDynamics dynamics_;
  Eigen::MatrixXd drive_;  ///< intervals x joints, of the log
};

}  // namespace faultline
