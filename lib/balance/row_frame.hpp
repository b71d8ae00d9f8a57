// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/row_setting.hpp"
#include "lib/balance/uniform_log.hpp"

namespace faultline {

/// What holds between neighbouring samples of a log.
struct Intervals {
  Eigen::MatrixXd velocity;     ///< of each sample
  Eigen::MatrixXd torque;       ///< that acts: intervals x joints
  Eigen::MatrixXd torque_step;  ///< from the sample before to the one after
  Eigen::MatrixXd q;            ///< at the middle
  Eigen::MatrixXd link_speed;   ///< smoothed, behind the spring
};

/// Rows of the coarse grid: interval `first` + k * step is the middle of row k.
struct CoarseGrid {
  int first = 0, step = 1, count = 0;
};

/// What rows and residuals of one log share.
struct RowFrame {
  Eigen::VectorXd kernel;
  CoarseGrid grid;
  Intervals at;
};

/// Throws Error(input) when the log is shorter than the kernels.
RowFrame row_frame(const UniformLog& log, const RowSetting& setting);

/// Speed of joint `joint` (from 0) behind the spring, by interval, from its velocity at each sample.
Eigen::VectorXd link_speed(const Eigen::VectorXd& velocity, const Eigen::VectorXd& torque,
                           const RowSetting& setting, int joint);

/// Velocity of joint `joint` (from 0) in each sample: the positions' differences where these are more
/// precise, the logged velocity where that one is.
Eigen::VectorXd fused_velocity(const JointReading& reading, const RowSetting& setting, int joint);

/// tanh(speed / width).
Eigen::VectorXd saturated(const Eigen::VectorXd& speed, double width);

inline JointVector row_of(const Eigen::MatrixXd& values, Eigen::Index k) { return values.row(k).transpose(); }

}  // namespace faultline
