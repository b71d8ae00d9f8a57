// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/one_step/linear_steps.hpp"

namespace faultline {

/// A reading with a greater variance than this does not exist.
inline constexpr double kNoReading = 1e8;
/// Variance to give a reading that does not exist.
inline constexpr double kMissingReading = 1e9;

/// What a Kalman filter needs of a log, as differences from the trajectory that the steps are linear about:
/// the data and, through the same filter, columns. Blocks of intervals or samples stand side by side.
struct FilterInput {
  Eigen::MatrixXd column;    ///< states x (columns * intervals): what each column adds to the next state
  Eigen::MatrixXd process;   ///< states x (states * intervals): covariance of what the prediction lacks
  Eigen::MatrixXd reading;   ///< states x samples: measured less trajectory
  Eigen::MatrixXd variance;  ///< states x samples: of the readings
  int read_column = -1;      ///< the column that reaches the readings, too; -1: none
  Eigen::MatrixXd read;      ///< states x samples: what that column adds to the readings

  int columns(int intervals) const { return static_cast<int>(column.cols()) / intervals; }
};

/// Output of the Kalman filter. The gains do not depend on the data, so the filter is linear in data and
/// columns.
struct Innovations {
  int states = 0, columns = 0, samples = 0;
  /// (states * samples) x (1 + columns): innovations of the readings in standard deviations: of the
  /// data, then what each column takes away from them. White with variance 1 when the model holds.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> white;
  Eigen::MatrixXd variance;       ///< states x samples: of each innovation; NaN where there is no reading
  Eigen::MatrixXd gain;           ///< states x (states * samples): one column a reading
  Eigen::MatrixXd before, after;  ///< states x ((1 + columns) * samples): state without and with the sample
  Eigen::MatrixXd before_covariance, after_covariance;  ///< states x (states * samples)
};

/// Readings are taken in one after the other (Anderson and Moore 1979, section 6.4).
Innovations innovations(const LinearSteps& steps, const FilterInput& input);

/// What columns that begin in interval `first` (and whose readings begin with sample `first`) take away from
/// the innovations of samples `first` to `end` (exclusive), with the gains of `filter`:
/// (states * (end - first)) x columns.
Eigen::MatrixXd white_columns(const LinearSteps& steps, const Innovations& filter,
                              const Eigen::MatrixXd& column, const Eigen::MatrixXd& read, int columns,
                              int first, int end);

/// The trajectory's correction given all readings (Rauch, Tung and Striebel 1965), the columns as large as
/// `size` says: states x samples. `variance`, if wanted, receives that of the correction.
Trajectory smoothed(const LinearSteps& steps, const Innovations& filter, const Eigen::VectorXd& size,
                    Eigen::MatrixXd* variance = nullptr);

/// Covariance of what the prediction lacks: each interval's unknown force (standard deviation joints x
/// intervals, N m or N) by what it does to the state.
Eigen::MatrixXd process_covariance(const LinearSteps& steps, const MotionLayout& layout,
                                   const Eigen::MatrixXd& force_std);

}  // namespace faultline
