// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/row_setting.hpp"
#include "lib/balance/uniform_log.hpp"

namespace faultline {

/// Signals between neighbouring samples of a log.
struct Intervals {
  Eigen::MatrixXd velocity;     ///< of each sample
  Eigen::MatrixXd torque;       ///< intervals x joints: torque that acts
  Eigen::MatrixXd torque_step;  ///< from the sample before to the one after
  Eigen::MatrixXd q;            ///< at the middle
  Eigen::MatrixXd link_speed;   ///< smoothed speed of the link, behind the spring
};

/// Rows of the coarse grid: interval `first` + k * step is the middle of row k.
struct CoarseGrid {
  int first = 0, step = 1, count = 0;
};

/// Kernel, grid and intervals of one log, for its rows and residuals.
struct RowFrame {
  Eigen::VectorXd kernel;
  CoarseGrid grid;
  Intervals at;
};

/// Returns the frame of a log. Throws Error(input) when the log is shorter than the kernels.
RowFrame row_frame(const UniformLog& log, const RowSetting& setting);

/// Returns the speed of joint `j` (from 0) behind the spring, by interval, from the velocity by sample.
Eigen::VectorXd link_speed(const Eigen::VectorXd& velocity, const Eigen::VectorXd& torque,
                           const RowSetting& setting, int j);

/// Returns the velocity of joint `j` (from 0) in each sample: position differences at low frequencies,
/// the logged velocity at high ones.
Eigen::VectorXd fused_velocity(const MeasuredMotion& reading, const RowSetting& setting, int j);

/// Returns what inertia, viscous and Coulomb friction of a coupled drive take of the drive's torque, by
/// interval: intervals x 3. `velocity` is that of each sample, `speed` that of the links, by joint.
Eigen::MatrixX3d drive_columns(const CoupledDrive& drive, const Eigen::MatrixXd& velocity,
                               const Eigen::MatrixXd& speed, double period_s);

/// tanh(speed / width).
Eigen::VectorXd saturated(const Eigen::VectorXd& speed, double width);

inline JointVector row_of(const Eigen::MatrixXd& values, Eigen::Index k) { return values.row(k).transpose(); }

}  // namespace faultline
