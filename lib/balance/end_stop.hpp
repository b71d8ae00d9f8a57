// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "lib/balance/balance_model.hpp"

namespace faultline {

/// Standard deviation (rows x joints, N m or N) of the unknown force of an end stop: large where a joint
/// halted abruptly outside the range of the healthy logs and stays there, else 0.
Eigen::MatrixXd stop_std(const BalanceRows& rows, const BalanceModel& model);

}  // namespace faultline
