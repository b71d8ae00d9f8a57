// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

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
  Eigen::VectorXd use;     ///< 1, or 0 for rows in which the joint rests
  std::vector<int> joint;  ///< of each row, from 0
  std::vector<int> log;    ///< of each row
  std::vector<int> block;  ///< of each row: block of time (residual_block_s()) of one log
  int blocks = 0;
  int joints = 0;
  Eigen::VectorXd width;  ///< ln of the friction widths chosen
};

/// Returns the length, s, of blocks over which residuals of `total_s` of logs may be correlated, for a
/// covariance of `parameters`: a second, less on short logs, since fewer blocks than parameters give no
/// covariance.
double residual_block_s(double total_s, double parameters);

WeakSystem assemble(const WeakSets& windows, const WeakChoice& choice);

/// Returns, by window of the set, whether joint `j` moves enough to distinguish its friction from stiction.
std::vector<bool> moving_windows(const WeakSets& windows, int set, int joint);

/// Whether only the `still` joints, from 1, have entries in column `p` of the system, up to noise.
bool is_shown_at_rest(const WeakSystem& system, int p, const std::vector<int>& still);

}  // namespace faultline
