// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

/// A log on a uniform grid, as filters need it. A sample that the log lacks or that has no value is
/// interpolated, and marked as lost where the gap is so long that the kernels of the rows do not span it.
struct UniformLog {
  double start_s = 0.0;   ///< time of the first row
  double period_s = 0.0;  ///< between two rows, as the stamps of this log show it
  Eigen::MatrixXd q, dq,
      tau;  ///< rows x joints; rad or m, rad/s or m/s, N m or N; `dq` is empty without a velocity
  std::vector<bool> lost;  ///< by row: interpolated
  /// By joint: standard deviation of the white noise of a row, see sample_noise().
  Eigen::VectorXd q_noise, dq_noise;

  int rows() const { return static_cast<int>(q.rows()); }
  int joints() const { return static_cast<int>(q.cols()); }
  double time_s(double row) const { return start_s + period_s * row; }
  /// First row at a time (within 1 ns) or behind it; rows() where there is none.
  int first_row(double time_s) const;
};

/// What a log says of the motion of one joint, by sample.
struct JointReading {
  Eigen::VectorXd q, dq;  ///< `dq` is empty without a velocity
};

JointReading reading_of(const UniformLog& log, int joint);

/// The whole log on a grid of about `period_s` that begins with its first row; each row goes to its most
/// likely point (see sample_grid). Throws Error(input) when the log has fewer than two rows.
UniformLog uniform_log(LogSource& log, double period_s);

/// Means of `samples` rows each, where the rows are so fine that the kernels see no difference. A mean is
/// lost where any of its samples is. A torque that is held from its sample on acts half a sample later than a
/// position; its mean is that of what acts in the meantime.
UniformLog averaged(UniformLog log, int samples, bool torque_is_held);

/// Its rows from `first` on.
UniformLog rows_from(const UniformLog& log, int first);
/// The first `rows` samples of the log.
UniformLog first_rows(UniformLog log, int rows);

/// The whole of each log, from its start, on grids of one period: that which the stamps of the middle log
/// show. Throws Error(input) when no log has two rows.
std::vector<UniformLog> uniform_logs(std::span<LogSource* const> logs);

/// Median over the logs of a value of each joint, such as its noise; `by_log` is not empty.
Eigen::VectorXd joint_medians(const std::vector<Eigen::VectorXd>& by_log);

/// Standard deviation of the white noise in each column, from its fourth differences, robust against motion
/// and steps.
Eigen::VectorXd sample_noise(const Eigen::MatrixXd& values);

}  // namespace faultline
