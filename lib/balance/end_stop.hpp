// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/balance_model.hpp"

namespace faultline {

// A joint that hits an end stop halts abruptly outside the range of the healthy logs and stays there.
inline constexpr double kFastBeforeStop = 0.15;  ///< share of its greatest healthy speed that it has before
inline constexpr double kHaltsIn_s = 0.06;       ///< longest time of the halt
inline constexpr double kStaysFor_s = 0.30;      ///< time for which it stays, at least

/// Rows or samples in which a joint is outside the range of the healthy logs.
struct StretchOutside {
  double side = 0.0;       ///< 1: above the range, -1: below
  int begin = 0, end = 0;  ///< the end is the first one after it
};

/// Returns the stretches in which the positions `q` are outside the range `low` to `high` by a share of it.
std::vector<StretchOutside> stretches_outside(const Eigen::VectorXd& q, double low, double high);

/// Returns the standard deviation of the unknown force of an end stop (rows x joints, N m or N): large if a
/// joint halted abruptly outside the range of the healthy logs and stays there, else 0.
Eigen::MatrixXd stop_std(const BalanceRows& rows, const BalanceModel& model);

}  // namespace faultline
