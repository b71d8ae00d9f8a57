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

/// Returns the rows with zeros in the balances that `mask` marks, so that a sum over them leaves these out.
BalanceRows without_balances(BalanceRows rows, const JointMask& mask);

}  // namespace faultline
