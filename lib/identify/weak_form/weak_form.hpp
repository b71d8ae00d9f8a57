// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "lib/core/joint.hpp"
#include "lib/identify/weak_form/weak_windows.hpp"

namespace faultline {

/// Windows, torque shift, friction widths and gain of each joint's balance.
struct WeakChoice {
  std::vector<int> set;        ///< by joint: index of its window length
  std::vector<int> shift;      ///< by joint: samples by which its torque acts later than logged
  std::vector<int> width;      ///< by joint: index of its friction width
  std::vector<int> bend;       ///< by joint: index of the width of its bent friction
  std::vector<double> gain{};  ///< by joint: true torque per logged torque; empty: all 1
};

/// The chosen balances as one system in the linear parameters of the space, joint after joint.
struct WeakSystem {
  Eigen::MatrixXd a;
  Eigen::VectorXd y;
  Eigen::VectorXd use;         ///< 1, or 0 for rows in which the joint rests
  std::vector<int> joint;      ///< of each row: its index
  std::vector<int> log;        ///< of each row
  std::vector<double> time_s;  ///< of each row: start of its window
  std::vector<int> block;      ///< of each row: block of time (residual_block_s()) of one log
  int blocks = 0;
  int joints = 0;
  Eigen::VectorXd width;  ///< ln of the friction widths chosen
};

/// Returns the length, s, of blocks over which residuals of `total_s` of logs may be correlated, for a
/// covariance of `parameters`: a second, less on short logs, since fewer blocks than parameters give no
/// covariance.
double residual_block_s(double total_s, double parameters);

/// Returns the number of seconds of the logs in which a window begins.
double seconds_covered(const WeakWindows& windows);

/// Returns the row of joint `j` of a window in the linear parameters of the space, with 0 for the timing.
/// `width`, `bend`: indices of its friction widths.
Eigen::RowVectorXd linear_row(const ParameterSpace& space, const WeakWindow& window, int j, int width,
                              int bend);

WeakSystem assemble(const WeakSets& windows, const WeakChoice& choice);

/// Returns the system with the blocks of its rows, for logs of `total_s`.
WeakSystem with_blocks(WeakSystem system, double total_s);

/// Returns, by window of the set, whether joint `j` moves enough to distinguish its friction from stiction.
std::vector<bool> moving_windows(const WeakSets& windows, int set, int j);

/// Whether only the `still` joints have entries in column `p` of the system, up to noise.
bool is_shown_at_rest(const WeakSystem& system, int p, const std::vector<Joint>& still);

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
