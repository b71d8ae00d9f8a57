// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/identify/parameter_space.hpp"
#include "lib/identify/weak_form/weak_system.hpp"

namespace faultline {

/// Solution of the windows' equations for the linear parameters of the space.
struct WeakFit {
  Eigen::VectorXd parameters;     ///< all of the space
  Eigen::MatrixXd covariance;     ///< of all; zero rows if kept. Jackknife over blocks of about a second
  std::vector<bool> free;         ///< false: kept at its given value
  std::vector<bool> confounded;   ///< true: not free, or with a part in a dependent column
  double condition_number = 0.0;  ///< of the base columns scaled to length 1
  std::vector<double> residual_rms, r2;  ///< by joint, N m or N, over the windows used
  int windows = 0;
  Eigen::VectorXd residual;  ///< of every row of the system
  Eigen::VectorXd weight;    ///< of every row: 1 / variance of its joint, less for outliers, 0 at rest
};

/// Weighted least squares (each joint by its own residual), outliers weighted down. Parameters that are not
/// in `wanted` or not identifiable keep their value of `start`.
WeakFit fit_weak_form(const WeakSystem& system, const ParameterSpace& space, const Eigen::VectorXd& start,
                      const std::vector<bool>& wanted);

/// Independent columns of the weighted system, chosen by pivoted QR of the scaled columns.
struct ColumnSelection {
  std::vector<int> columns;       ///< in their order
  std::vector<bool> confounded;   ///< of all columns: excluded, or with a part in an excluded column
  double condition_number = 0.0;  ///< of the chosen columns below `rigid`, scaled to length 1
};

/// Selects from the columns that `wanted` allows; the first `rigid` ones are those of the base parameters.
ColumnSelection select_columns(const Eigen::MatrixXd& a, const std::vector<bool>& wanted, int rigid);

}  // namespace faultline
