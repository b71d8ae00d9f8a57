// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/balance_model.hpp"

namespace faultline {

/// Returns the standard deviation of the unknown force of an end stop (rows x joints, N m or N): large if a
/// joint halted abruptly outside the range of the healthy logs and stays there, else 0.
Eigen::MatrixXd stop_std(const BalanceRows& rows, const BalanceModel& model);

}  // namespace faultline
