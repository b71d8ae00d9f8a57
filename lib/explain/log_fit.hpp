// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lib/balance/balance_model.hpp"
#include "lib/balance/regress.hpp"
#include "lib/balance/uniform_log.hpp"
#include "lib/balance/work_piece.hpp"

namespace faultline {

/// A value of every row and joint of a log, joint after joint: joint * rows + row.
using Stacked = Eigen::VectorXd;
/// Columns of such values.
using StackedColumns = Eigen::MatrixXd;
/// Rows that count for nothing, stacked.
using StackedMask = std::vector<bool>;

/// Columns of a hypothesis with the prior variance of their sizes.
struct FaultColumns {
  StackedColumns column;  ///< (joints * rows) x sizes
  Eigen::VectorXd variance;

  int sizes() const { return static_cast<int>(column.cols()); }
};

/// How well a log is explained by the robot, the day's effects and the columns of a hypothesis.
struct Explanation {
  double log_likelihood = 0.0;  ///< marginal: effects, sizes and changes of the work piece integrated out
  Eigen::VectorXd day;          ///< effects of the day
  Eigen::VectorXd size;         ///< of the hypothesis' columns
  Stacked left;                 ///< whitened rows left over; NaN where rows do not count
  PiecePath path;               ///< of the work piece; empty without one
  Eigen::VectorXd piece_level;  ///< the path, smoothed
  Eigen::VectorXd row_gain;     ///< by sample, at coarse rates: nats by which it beats the healthy robot
  double mean_square() const;   ///< of what is left: 1 where it is noise
};

/// One log against one model: what all hypotheses share.
class LogFit {
 public:
  /// Throws Error(input) when the log is shorter than the kernels. The model must outlive it.
  LogFit(UniformLog log, const BalanceModel& model);

  const UniformLog& log() const { return log_; }
  const BalanceModel& model() const { return model_; }
  const BalanceRows& rows() const { return rows_; }
  int count() const { return rows_.rows(); }
  int joints() const { return model_.joints(); }
  const Eigen::VectorXd& time_s() const { return rows_.time_s; }
  const Eigen::VectorXd& loudness() const { return loudness_; }
  /// Standard deviation of each row, rows x joints.
  const Eigen::MatrixXd& std() const { return std_; }
  /// Torque that the robot leaves unexplained, without effects of the day.
  const Stacked& residual() const { return residual_; }
  /// The same of another trajectory of this log.
  Stacked residual_of(const UniformLog& moved) const;
  const std::vector<Eigen::MatrixXd>& day_columns() const { return day_column_; }
  /// Columns of the effects of a day, whitened and stacked.
  const StackedColumns& white_day() const { return day_white_; }
  const Eigen::MatrixXd& tip_torque() const { return tip_; }
  const Explanation& healthy() const { return healthy_; }
  /// Path of the work piece before anything was known of the day.
  const PiecePath& first_path() const { return first_path_; }
  bool has_piece() const { return model_.piece_kg > 0.0; }

  Stacked whitened(const Stacked& torque) const;
  StackedColumns whitened(const StackedColumns& columns) const;

  /// The log explained with these columns; `path` holds where a work piece is known to come and go.
  Explanation explain(const Stacked& residual, const FaultColumns& columns, const PiecePath& path,
                      const StackedMask& dropped = {}) const;
  /// The same with the path of the work piece that fits the hypothesis best, from several starts: `starts`
  /// are sizes to begin with, empty for the path of the healthy log. `onset_s` is that of the hypothesis:
  /// effects of the day are first taken from the rows before it.
  Explanation explain_with_piece(const Stacked& residual, const FaultColumns& columns,
                                 const std::vector<Eigen::VectorXd>& starts, double onset_s,
                                 const StackedMask& dropped = {}) const;
  /// Torque of the effects of a day.
  Stacked day_torque(const Eigen::VectorXd& day) const;
  Stacked piece_torque(const Eigen::VectorXd& level) const;
  /// Effects of the day as the rows before `time_s` show them.
  Eigen::VectorXd day_before(double time_s) const;
  /// Step at `onset_s`, smoothed as the rows are.
  Eigen::VectorXd soft_step(double onset_s) const;

 private:
  PiecePath path_of(const Stacked& left, const StackedMask& dropped, bool wide) const;

  UniformLog log_;
  const BalanceModel& model_;
  BalanceRows rows_;
  Eigen::VectorXd loudness_;
  Eigen::MatrixXd std_, tip_;
  Stacked residual_, spring_;
  std::vector<Eigen::MatrixXd> day_column_;
  StackedColumns day_white_;
  Eigen::MatrixXd day_square_;
  Eigen::VectorXd day_precision_;
  PiecePath first_path_;
  Explanation healthy_;
  mutable std::vector<std::pair<int, Eigen::VectorXd>> before_;
};

/// Rows x joints from a stacked value, and back.
Eigen::MatrixXd unstacked(const Stacked& values, int joints);
Stacked stacked(const Eigen::MatrixXd& values);

}  // namespace faultline
