// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "lib/log/log_source.hpp"

namespace faultline {

/// A log on a uniform grid, as filters need it. A sample that is missing or has no value is interpolated, and
/// marked as lost if the gap is longer than what the kernels of the rows span.
struct UniformLog {
  double start_s = 0.0;   ///< time of the first row
  double period_s = 0.0;  ///< between two rows, as the stamps of this log show it
  Eigen::MatrixXd q, dq,
      tau;  ///< rows x joints; rad or m, rad/s or m/s, N m or N; `dq` is empty without a velocity
  std::vector<bool> lost;  ///< by row: interpolated in a gap that is too long to be bridged
  /// By joint: standard deviation of the white noise of a row, see sample_noise().
  Eigen::VectorXd q_noise, dq_noise;

  int rows() const { return static_cast<int>(q.rows()); }
  int joints() const { return static_cast<int>(q.cols()); }
  double time_s(double row) const { return start_s + period_s * row; }
  /// Returns the first row at a time (within 1 ns) or after it; rows() if there is none.
  int first_row(double time_s) const;
};

/// Measured motion of one joint, by sample.
struct MeasuredMotion {
  Eigen::VectorXd q, dq;  ///< `dq` is empty without a velocity
};

MeasuredMotion reading_of(const UniformLog& log, int j);

/// Returns the rows on a grid of about `period_s` that begins with the first row; each row goes to its most
/// likely point (see sample_grid). Empty if fewer than two rows have all values.
std::optional<UniformLog> uniform_rows(const Log& all, double period_s);
/// Reads the whole log onto such a grid. Throws Error(input) when fewer than two rows have all values.
UniformLog uniform_log(LogSource& log, double period_s);

/// Returns means of `samples` rows each, for rows so fine that the kernels do not distinguish them. A mean is
/// lost if any of its samples is. A held torque acts half a sample later than a position is measured; its
/// mean is that of the torque that acts during these samples.
UniformLog averaged(UniformLog log, int samples, bool torque_is_held);

/// Returns the `rows` rows of the log from `first` on.
UniformLog part_of(const UniformLog& log, int first, int rows);

/// Reads each whole log, from its start, onto grids of one period: the median of the periods of the logs.
/// Throws Error(input) when there is no log, or one with fewer than two rows that have all values.
std::vector<UniformLog> uniform_logs(std::span<LogSource* const> logs);

/// Returns the median over the logs of a value of each joint, such as its noise; `by_log` is not empty.
Eigen::VectorXd joint_medians(const std::vector<Eigen::VectorXd>& by_log);

/// Estimates the standard deviation of the white noise in each column from its fourth differences, robust
/// against motion and steps. Differences of 0 do not count: a coarse encoder repeats its value at rest.
Eigen::VectorXd sample_noise(const Eigen::MatrixXd& values);

/// Samples of each joint that repeat the position before.
struct RepeatedPositions {
  Eigen::VectorXi longest;  ///< longest run of them
  Eigen::VectorXd share;    ///< of all samples but the first
};
RepeatedPositions repeated_positions(const UniformLog& log);

}  // namespace faultline
