// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/balance_model.hpp"

namespace faultline {

/// Returns for each row and joint whether the joint rests: its speed stays below `slow` (by joint, rad/s or
/// m/s) for at least three rows, of which the rows beside are a part, since their kernels reach the rest. A
/// velocity that changes its sign takes less.
JointMask resting_rows(const BalanceRows& rows, const Eigen::VectorXd& slow);

/// Returns the rows in which joints rest that stick (BalanceModel::stiction). Empty if no joint sticks.
JointMask sticking_rows(const BalanceRows& rows, const BalanceModel& model);

/// Returns the rows of resting joints that stick, if their residual torque
/// `residual` (rows x joints) is within the static friction; they show nothing. Empty if no joint sticks.
JointMask rows_within_stiction(const BalanceRows& rows, const BalanceModel& model,
                               const Eigen::MatrixXd& residual);

/// Returns the rows in which a joint's torque is at the limit of its drive (BalanceModel::drive_limit) or
/// beyond, and the rows beside. Empty if no drive has a limit.
JointMask rows_at_limit(const BalanceRows& rows, const BalanceModel& model);

/// Returns the balances of healthy logs that show nothing: sticking_rows() and rows_at_limit(). Empty if
/// there is none.
JointMask silent_balances(const BalanceRows& rows, const BalanceModel& model);

/// Returns the rows with zeros in the balances that `mask` marks, so that a sum over them leaves these out.
BalanceRows without_balances(BalanceRows rows, const JointMask& mask);

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
