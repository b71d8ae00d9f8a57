// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/one_step/linear_steps.hpp"

namespace faultline {

/// Variance above which a measurement counts as missing.
inline constexpr double kNoReading = 1e8;
/// Variance that marks a missing measurement.
inline constexpr double kMissingReading = 1e9;

/// Input of the Kalman filter: measurements and columns of a log, as differences from the trajectory about
/// which the steps are linear. Blocks of intervals or samples stand side by side.
struct FilterInput {
  Eigen::MatrixXd column;    ///< states x (columns * intervals): what each column adds to the next state
  Eigen::MatrixXd process;   ///< states x (states * intervals): covariance of the prediction error
  Eigen::MatrixXd reading;   ///< states x samples: measured minus trajectory
  Eigen::MatrixXd variance;  ///< states x samples: of the measurements
  int read_column = -1;      ///< index of the column that also acts on the measurements; -1: none
  Eigen::MatrixXd read;      ///< states x samples: what that column adds to the measurements

  int columns(int intervals) const { return static_cast<int>(column.cols()) / intervals; }
};

/// Output of the Kalman filter. The gains do not depend on the data, so the filter is linear in data and
/// columns.
struct Innovations {
  int states = 0, columns = 0, samples = 0;
  /// (states * samples) x (1 + columns): whitened innovations of the data, then what a size of 1 of each
  /// column subtracts from them. Those of the data are independent with variance 1 if the model holds.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> white;
  Eigen::MatrixXd variance;       ///< states x samples: of each innovation; NaN without a measurement
  Eigen::MatrixXd gain;           ///< states x (states * samples): one column for each measurement
  Eigen::MatrixXd before, after;  ///< states x ((1 + columns) * samples): predicted and updated state
  Eigen::MatrixXd before_covariance, after_covariance;  ///< states x (states * samples)
};

/// Runs the Kalman filter, which takes in the measurements of a sample one by one (Anderson and Moore 1979,
/// section 6.4).
Innovations innovations(const LinearSteps& steps, const FilterInput& input);

/// Returns what columns subtract from the whitened innovations of samples `first` to `end` (exclusive), with
/// the gains of `filter`, if they begin in interval `first` (and their parts in the measurements with sample
/// `first`): (states * (end - first)) x columns.
Eigen::MatrixXd white_columns(const LinearSteps& steps, const Innovations& filter,
                              const Eigen::MatrixXd& column, const Eigen::MatrixXd& read, int columns,
                              int first, int end);

/// Returns the correction of the trajectory given all measurements (Rauch, Tung and Striebel 1965) if the
/// columns have the sizes `size`: states x samples. Writes its variance to `variance` unless that is null.
Trajectory smoothed(const LinearSteps& steps, const Innovations& filter, const Eigen::VectorXd& size,
                    Eigen::MatrixXd* variance = nullptr);

/// Returns the covariance of the prediction error, states x (states * intervals): that of the unknown force
/// of each interval (standard deviation joints x intervals, N m or N), propagated to the state.
Eigen::MatrixXd process_covariance(const LinearSteps& steps, const MotionLayout& layout,
                                   const Eigen::MatrixXd& force_std);

}  // namespace faultline
