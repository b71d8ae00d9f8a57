// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/row_frame.hpp"
#include "lib/robot/fast_dynamics.hpp"

namespace faultline {

/// Torque that a robot leaves unexplained in the rows of a log, without the torque of the springs: the same
/// as torque - column * theta of BalanceRows, but without the columns; of the log and of trajectories that
/// differ from it in the readings of one joint.
class ReadingResidual {
 public:
  /// Throws Error(input) when the log is shorter than the kernels.
  ReadingResidual(const UniformLog& log, RowSetting setting, const RigidColumns& rigid,
                  Eigen::VectorXd theta);

  /// Rows from `first_row` on x joints, of a log that has other readings of joint `joint` (from 0).
  Eigen::MatrixXd of(const JointReading& moved, int joint, int first_row = 0) const;

 private:
  /// What drive and friction give joint `joint` in each interval.
  Eigen::VectorXd drive(int joint, const Eigen::VectorXd& speed, const Eigen::VectorXd& q) const;

  RowSetting setting_;
  ColumnLayout layout_;
  Eigen::VectorXd theta_;
  RowFrame frame_;
  Eigen::MatrixXd q_;  ///< joints x samples, of the log
  FastDynamics dynamics_;
  Eigen::MatrixXd drive_;  ///< intervals x joints, of the log
};

}  // namespace faultline
